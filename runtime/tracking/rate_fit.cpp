#include "runtime/tracking/rate_fit.h"
#include <algorithm>

namespace arift
{

RateFit::Motion RateFit::add(const glm::dvec3 &rate, double period)
{
	entries_[next_] = {rate, period};
	next_ = (next_ + 1) % capacity;
	count_ = std::min(count_ + 1, capacity);

	double end = 0, n = 0, sumT = 0, sumTT = 0;
	glm::dvec3 sum(0), sumTRate(0);
	for (size_t i = 0; i < count_ && (i == 0 || end - entries_[(next_ + capacity - 1 - i) % capacity].period > -window * 1.01); ++i) {
		const Entry &entry = entries_[(next_ + capacity - 1 - i) % capacity];
		const double t = end - entry.period / 2;
		end -= entry.period;
		n += 1;
		sumT += t;
		sumTT += t * t;
		sum += entry.rate;
		sumTRate += entry.rate * t;
	}
	const double spread = n * sumTT - sumT * sumT;
	if (n < 2 || spread <= 0) return {rate, glm::dvec3(0)};
	const glm::dvec3 slope = (sumTRate * n - sum * sumT) / spread;
	return {(sum - slope * sumT) / n, slope};
}

} // namespace arift
