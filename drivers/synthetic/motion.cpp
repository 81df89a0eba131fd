#include "drivers/synthetic/motion.h"
#include "runtime/device/imu_tracker.h"
#include <algorithm>
#include <array>
#include <random>

namespace arift::synthetic
{

namespace
{

/// A value and its first two derivatives by time.
struct Jet {
	double value = 0, first = 0, second = 0;
};

Jet operator*(const Jet &a, const Jet &b)
{
	return {a.value * b.value, a.first * b.value + a.value * b.first, a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

/// From 0 to 1 within `length` seconds, with continuous second derivative.
Jet smoothStep(double time, double length)
{
	const double s = std::clamp(time / length, 0.0, 1.0);
	return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 + s * (s - 2)) / length,
			60 * s * (1 + s * (2 * s - 3)) / (length * length)};
}

/// A turn about a pivot that stands still.
HeadState turned(const glm::dquat &orientation, const glm::dvec3 &velocity, const glm::dvec3 &acceleration, const glm::dvec3 &neckInHead)
{
	const glm::dvec3 headFromNeck = -neckInHead;
	HeadState state{orientation, neckInHead + orientation * headFromNeck, {}, velocity, acceleration};
	state.acceleration = orientation * (glm::cross(acceleration, headFromNeck) + glm::cross(velocity, glm::cross(velocity, headFromNeck)));
	return state;
}

class Rest final : public HeadMotion
{
public:
	HeadState at(double) const override { return {}; }
};

class ConstantRate final : public HeadMotion
{
public:
	ConstantRate(const glm::dvec3 &rate, double delay, const glm::dvec3 &neckInHead) : rate_(rate), delay_(delay), neckInHead_(neckInHead)
	{
	}

	HeadState at(double seconds) const override
	{
		const Jet turn = delay_ > 0 ? speedingUp(seconds - delay_) : Jet{seconds, 1, 0};
		return turned(rotationOf(rate_ * turn.value), rate_ * turn.first, rate_ * turn.second, neckInHead_);
	}

private:
	/// Seconds turned at full rate, the speed following half a cosine.
	static Jet speedingUp(double time)
	{
		constexpr double length = 0.25, frequency = M_PI / length;
		if (time <= 0) return {};
		if (time >= length) return {time - length / 2, 1, 0};
		return {time / 2 - std::sin(frequency * time) / (2 * frequency), (1 - std::cos(frequency * time)) / 2,
				frequency * std::sin(frequency * time) / 2};
	}

	const glm::dvec3 rate_;
	const double delay_;
	const glm::dvec3 neckInHead_;
};

struct Sine {
	double amplitude, frequency, phase; // radians, rad/s, radians
};

class Natural final : public HeadMotion
{
public:
	Natural(uint64_t seed, double delay, const glm::dvec3 &neckInHead) : delay_(delay), neckInHead_(neckInHead)
	{
		// Degrees and hertz: slow turns of the gaze, quicker corrections, a little tremor. Each frequency is detuned by the seed.
		yaw_ = detuned({{{27, 0.083}, {13, 0.271}, {5, 0.737}, {0.8, 1.93}}}, seed * 3 + 1);
		pitch_ = detuned({{{8, 0.113}, {5, 0.353}, {1.8, 0.919}, {0.4, 2.31}}}, seed * 3 + 2);
		roll_ = detuned({{{3, 0.137}, {1.6, 0.431}, {0.6, 1.13}, {0.2, 2.57}}}, seed * 3 + 3);
	}

	/// orientation = yaw about y, then pitch about x, then roll about z.
	HeadState at(double seconds) const override
	{
		const double time = seconds - delay_;
		if (time <= 0) return {};
		const Jet yaw = sum(yaw_, time), pitch = sum(pitch_, time), roll = sum(roll_, time);
		const double sine = std::sin(pitch.value), cosine = std::cos(pitch.value);
		const glm::dvec3 up{0, cosine, -sine}, upRate = glm::dvec3{0, -sine, -cosine} * pitch.first; // the vertical as pitch sees it
		const glm::dvec3 x{1, 0, 0}, z{0, 0, 1};
		const glm::dvec3 velocity = up * yaw.first + x * pitch.first;
		const glm::dvec3 acceleration = up * yaw.second + upRate * yaw.first + x * pitch.second;
		const glm::dquat rolled = rotationOf({0, 0, -roll.value});
		const glm::dvec3 inHead = rolled * velocity;
		const glm::dquat orientation = rotationOf({0, yaw.value, 0}) * rotationOf({pitch.value, 0, 0}) * rotationOf({0, 0, roll.value});
		return turned(orientation, inHead + z * roll.first, rolled * acceleration - glm::cross(z * roll.first, inHead) + z * roll.second,
					  neckInHead_);
	}

private:
	using Sines = std::array<Sine, 4>;

	static Sines detuned(const std::array<std::array<double, 2>, 4> &parts, uint64_t seed)
	{
		std::mt19937_64 random(seed);
		std::uniform_real_distribution<double> detune(0.93, 1.07), phase(0, 2 * M_PI);
		Sines sines;
		for (size_t i = 0; i < parts.size(); i++)
			sines[i] = {parts[i][0] * M_PI / 180, 2 * M_PI * parts[i][1] * detune(random), phase(random)};
		return sines;
	}

	static Jet sum(const Sines &sines, double time)
	{
		Jet total;
		for (const Sine &sine : sines) {
			const double angle = sine.frequency * time + sine.phase;
			total.value += sine.amplitude * std::sin(angle);
			total.first += sine.amplitude * sine.frequency * std::cos(angle);
			total.second -= sine.amplitude * sine.frequency * sine.frequency * std::sin(angle);
		}
		return smoothStep(time, 1.5) * total;
	}

	Sines yaw_, pitch_, roll_;
	const double delay_;
	const glm::dvec3 neckInHead_;
};

} // namespace

std::unique_ptr<HeadMotion> makeRest() { return std::make_unique<Rest>(); }

std::unique_ptr<HeadMotion> makeConstantRate(const glm::dvec3 &rate, double delay, const glm::dvec3 &neckInHead)
{
	return std::make_unique<ConstantRate>(rate, delay, neckInHead);
}

std::unique_ptr<HeadMotion> makeNatural(uint64_t seed, double delay, const glm::dvec3 &neckInHead)
{
	return std::make_unique<Natural>(seed, delay, neckInHead);
}

ImuTruth imuTruth(const HeadState &head, const XrPosef &imuInHead)
{
	const glm::dvec3 lever = toGlm(imuInHead.position);
	const glm::dvec3 force = glm::conjugate(head.orientation) * (head.acceleration + glm::dvec3{0, standardGravity, 0}) +
							 glm::cross(head.angularAcceleration, lever) +
							 glm::cross(head.angularVelocity, glm::cross(head.angularVelocity, lever));
	const glm::dquat headInImu = glm::conjugate(toGlm(imuInHead.orientation));
	return {headInImu * force, headInImu * head.angularVelocity};
}

} // namespace arift::synthetic
