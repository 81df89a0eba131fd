#include "runtime/optics/polynomial.h"
#include <Eigen/QR>
#include <limits>
#include <utility>

namespace arift
{

namespace
{

/// Chebyshev polynomials T0 ... at each sample: well conditioned where powers of x are not.
Eigen::MatrixXd chebyshevBasis(std::span<const FitSample> samples, size_t size)
{
	Eigen::MatrixXd basis(samples.size(), size);
	for (size_t row = 0; row < samples.size(); ++row) {
		const double x = samples[row].x;
		for (size_t k = 0; k < size; ++k) basis(row, k) = k == 0 ? 1.0 : k == 1 ? x : 2 * x * basis(row, k - 1) - basis(row, k - 2);
	}
	return basis;
}

std::vector<double> powersFromChebyshev(const Eigen::VectorXd &series)
{
	const size_t size = size_t(series.size());
	std::vector<double> sum(size), previous(size), current(size);
	current[0] = 1;
	for (size_t k = 0; k < size; ++k) {
		for (size_t i = 0; i < size; ++i) sum[i] += series[Eigen::Index(k)] * current[i];
		std::vector<double> next(size);
		for (size_t i = 0; i + 1 < size; ++i) next[i + 1] = (k == 0 ? 1 : 2) * current[i];
		for (size_t i = 0; i < size; ++i) next[i] -= previous[i];
		previous = std::exchange(current, std::move(next));
	}
	return sum;
}

} // namespace

std::vector<double> fitPolynomial(std::span<const FitSample> samples, size_t size)
{
	const Eigen::Index count = Eigen::Index(samples.size());
	const Eigen::MatrixXd basis = chebyshevBasis(samples, size);
	Eigen::VectorXd target(count), weight(count);
	for (Eigen::Index i = 0; i < count; ++i) {
		target[i] = samples[size_t(i)].y;
		weight[i] = samples[size_t(i)].weight;
	}
	Eigen::VectorXd emphasis = Eigen::VectorXd::Ones(count), best;
	double smallest = std::numeric_limits<double>::infinity();
	for (int step = 0; step < 16; ++step) {
		const Eigen::VectorXd w = weight.cwiseProduct(emphasis.cwiseSqrt());
		const Eigen::VectorXd series = (w.asDiagonal() * basis).householderQr().solve(w.cwiseProduct(target));
		const Eigen::VectorXd error = weight.cwiseProduct(basis * series - target).cwiseAbs();
		if (error.maxCoeff() < smallest) {
			smallest = error.maxCoeff();
			best = series;
		}
		emphasis = emphasis.cwiseProduct(error.array().max(1e-6 * error.maxCoeff() + 1e-300).matrix());
		emphasis /= emphasis.mean();
	}
	return powersFromChebyshev(best);
}

std::vector<double> substitute(std::span<const double> polynomial, double offset, double scale)
{
	std::vector<double> result(polynomial.size());
	for (size_t i = polynomial.size(); i-- > 0;) {
		// result = result * (offset + scale u) + polynomial[i], highest power first so that each is still the old one when read
		for (size_t k = result.size(); k-- > 0;) result[k] = result[k] * offset + (k > 0 ? result[k - 1] * scale : 0);
		result[0] += polynomial[i];
	}
	return result;
}

} // namespace arift
