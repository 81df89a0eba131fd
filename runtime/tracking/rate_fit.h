// Angular velocity now and angular acceleration, from the rates of the last hundredth of a second.
#pragma once
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>

namespace arift
{

/// A straight line through the rates by least squares. Each stands for the middle of its interval; the line is read at the end of the last.
class RateFit
{
public:
	struct Motion {
		glm::dvec3 rate{0};         ///< rad/s
		glm::dvec3 acceleration{0}; ///< rad/s^2
	};
	/// `rate` over the `period` seconds that end now.
	Motion add(const glm::dvec3 &rate, double period);
	/// Forgets: the next rate does not continue the last.
	void reset() { count_ = 0; }

private:
	static constexpr double window = 0.010; ///< seconds
	static constexpr size_t capacity = 16;
	struct Entry {
		glm::dvec3 rate;
		double period;
	};
	std::array<Entry, capacity> entries_; ///< the newest at next_ - 1
	size_t next_ = 0, count_ = 0;
};

} // namespace arift
