#include "runtime/tracking/orientation_filter.h"
#include "runtime/base/pose.h"
#include <algorithm>

namespace arift
{
namespace
{

bool isFinite(const glm::dvec3 &v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
double squared(const glm::dvec3 &v) { return glm::dot(v, v); }
double squared(double x) { return x * x; }
double greatest(const glm::dvec3 &v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::array<double, 3> signals(const glm::dvec3 &v) { return {v.x, v.y, v.z}; }
glm::dvec3 vector(const std::array<double, 3> &v) { return {v[0], v[1], v[2]}; }

/// The shortest rotation that takes the unit vector `up` to (0, 0, 1): level axis, equations 12 and 13 of the paper.
glm::dquat levelling(const glm::dvec3 &up)
{
	const double w = std::sqrt(std::max(0.0, (up.z + 1) / 2));
	const double half = 0.5 / w;
	return w > 1e-6 ? glm::dquat(w, half * up.y, -half * up.x, 0) : glm::dquat(0, 1, 0, 0);
}

} // namespace

OrientationCoefficients::OrientationCoefficients(const OrientationParameters &parameters, double samplePeriod)
	: period(samplePeriod), rest(parameters.restTau, samplePeriod), biasError(parameters.biasErrorTau, samplePeriod)
{
	const double wander = 0.1 * degree;
	biasNoise = wander * wander * samplePeriod / parameters.biasForgettingTime;
	biasInitial = parameters.biasSigmaInit * parameters.biasSigmaInit;
	// Chosen such that the filter's covariance, fed with nothing else, converges to sigma^2 (equation 24).
	const auto variance = [this](double sigma) { return sigma * sigma * (sigma * sigma / biasNoise + 1); };
	biasMotion = variance(parameters.biasSigmaMotion);
	biasRest = variance(parameters.biasSigmaRest);
}

OrientationFilter::OrientationFilter(double samplePeriod, const OrientationParameters &parameters)
	: parameters_(parameters), coefficients_(parameters, samplePeriod)
{
	state_.biasCovariance = glm::dmat3(coefficients_.biasInitial);
}

void OrientationFilter::update(const glm::dvec3 &measuredRate, const glm::dvec3 &acceleration, double period)
{
	if (!(period > 0)) return;
	if (!(period <= parameters_.longestStep)) return interrupt();
	if (std::abs(period - coefficients_.period) > 1e-3 * period) coefficients_ = OrientationCoefficients(parameters_, period);
	if (isFinite(measuredRate)) state_.lastRate = measuredRate;
	const glm::dvec3 limit(parameters_.gyroscopeRange), rate = glm::clamp(state_.lastRate, -limit, limit) - state_.bias;
	if (greatest(state_.lastRate) >= parameters_.gyroscopeRange) state_.unbroken = std::min(state_.unbroken, 0.5);

	state_.gyroscopeOnly = glm::normalize(state_.gyroscopeOnly * rotationOf(rate * period));
	const double memory = std::clamp(state_.unbroken, period, parameters_.meanTurnTau);
	state_.meanTurn += (glm::length(rate) - state_.meanTurn) * (period / memory);
	if (isFinite(acceleration) && glm::dot(acceleration, acceleration) > 0) {
		detectRest(state_.lastRate, acceleration);
		const bool starting = !state_.settled;
		const LowPassCoefficients lowPass(accelerationTau(), period);
		const glm::dvec3 up = correctInclination(acceleration, lowPass);
		estimateBias(up, lowPass, starting ? 0 : period);
	}
	state_.unbroken += period;
}

void OrientationFilter::interrupt()
{
	state_.unbroken = state_.stillFor = 0;
	state_.settled = state_.resting = false;
}

/// Section 3.6: at rest when rate and acceleration have long not left their means and the mean rate can be a bias.
void OrientationFilter::detectRest(const glm::dvec3 &rate, const glm::dvec3 &acceleration)
{
	if (!state_.settled) {
		state_.restRate.settle(signals(rate));
		state_.restAcceleration.settle(signals(acceleration));
	}
	state_.meanRate = vector(state_.restRate.step(signals(rate), coefficients_.rest));
	const glm::dvec3 meanAcceleration = vector(state_.restAcceleration.step(signals(acceleration), coefficients_.rest));
	const bool still = squared(rate - state_.meanRate) <= squared(parameters_.restRate) &&
					   squared(acceleration - meanAcceleration) <= squared(parameters_.restAcceleration) &&
					   greatest(state_.meanRate - state_.restBias) <= biasClip();
	state_.stillFor = still ? state_.stillFor + coefficients_.period : 0;
	const bool ordinary = greatest(state_.meanRate - state_.restBias) <= parameters_.biasClip;
	state_.resting = state_.stillFor >= (ordinary ? parameters_.restTime : parameters_.restTimeFirst);
	// What was integrated with a bias nobody knew is no memory to keep: the inclination is averaged anew.
	if (state_.resting && !state_.rested) state_.unbroken = 0;
}

/// How long the acceleration is averaged: long while the integrated rates can be trusted for so long, short while they cannot. Their error
/// per second is what the bias is wrong by, and a share of the rate of turn (scale and misalignment).
double OrientationFilter::accelerationTau() const
{
	const double distrust = state_.meanTurn / parameters_.trustedTurn + state_.persistence;
	const double longest = state_.resting ? parameters_.tauAccelerationRest : parameters_.tauAcceleration;
	return std::min(longest / (1 + distrust), std::max(parameters_.tauAccelerationStart, state_.unbroken));
}

/// Section 3.2: the acceleration, low-passed in the almost inertial frame, points up. Returns where it pointed before the correction.
glm::dvec3 OrientationFilter::correctInclination(const glm::dvec3 &acceleration, const LowPassCoefficients &lowPass)
{
	const glm::dvec3 inertial = state_.gyroscopeOnly * acceleration;
	if (!state_.settled) state_.acceleration.settle(signals(inertial));
	const glm::dvec3 smooth = vector(state_.acceleration.step(signals(inertial), lowPass));
	state_.settled = true;
	const double norm = glm::length(smooth);
	if (norm < 1e-9) return {0, 0, 1};
	const glm::dvec3 up = state_.inclination * (smooth * (1 / norm));
	state_.inclination = glm::normalize(levelling(up) * state_.inclination);
	return up;
}

/// Section 3.5: a Kalman filter with the bias as its state. In motion, the rate at which the inclination had to be corrected is the level
/// part of the bias error, seen through the acceleration's low-pass; at rest the mean rate is the bias. Nothing is said about the bias
/// around the vertical in motion (the paper pulls it to zero).
void OrientationFilter::estimateBias(const glm::dvec3 &up, const LowPassCoefficients &lowPass, double period)
{
	OrientationState &s = state_;
	const glm::dmat3 imuInEarth = glm::mat3_cast(orientation());
	const glm::dvec3 level[2] = {{imuInEarth[0][0], imuInEarth[1][0], imuInEarth[2][0]},
								 {imuInEarth[0][1], imuInEarth[1][1], imuInEarth[2][1]}};
	const LowPass<8>::Signals exact{
		level[0].x, level[0].y, level[0].z, level[1].x, level[1].y, level[1].z, glm::dot(level[0], s.bias), glm::dot(level[1], s.bias)};
	if (period == 0) {
		s.rotation.settle(exact);
		s.biasError = {};
	}
	const LowPass<8>::Signals late = s.rotation.step(exact, lowPass);
	const glm::dvec3 rows[2] = {{late[0], late[1], late[2]}, {late[3], late[4], late[5]}};
	const double clip = biasClip();
	const double perSecond = period == 0 ? 0 : 1 / period;
	const std::array<double, 2> errors{std::clamp(-up.y * perSecond + late[6] - glm::dot(rows[0], s.bias), -clip, clip),
									   std::clamp(up.x * perSecond + late[7] - glm::dot(rows[1], s.bias), -clip, clip)};
	const std::array<double, 2> lasting = s.biasError.step(errors, coefficients_.biasError);
	s.persistence = (squared(lasting[0]) + squared(lasting[1])) / squared(parameters_.trustedBias);
	const glm::dvec3 before = s.bias;
	for (int i = 0; i < 3; ++i)
		s.biasCovariance[i][i] = std::min(s.biasCovariance[i][i] + coefficients_.biasNoise, coefficients_.biasInitial);
	const auto observe = [&](const glm::dvec3 &direction, double error, double variance) {
		observeBias(direction, std::clamp(error, -clip, clip) - glm::dot(direction, s.bias - before), variance);
	};
	if (s.resting) {
		for (int i = 0; i < 3; ++i) {
			glm::dvec3 axis(0);
			axis[i] = 1;
			observe(axis, s.meanRate[i] - before[i], coefficients_.biasRest);
		}
		s.rested = true;
		s.restBias = s.bias;
	} else {
		const double variance = coefficients_.biasMotion / (1 + parameters_.biasPersistence * s.persistence);
		for (int row = 0; row < 2; ++row) observe(rows[row], errors[row], variance);
	}
	s.bias = glm::clamp(s.bias, s.restBias - clip, s.restBias + clip);
}

/// One scalar measurement: direction * (bias error) = error, with this variance.
void OrientationFilter::observeBias(const glm::dvec3 &direction, double error, double variance)
{
	const glm::dvec3 shared = state_.biasCovariance * direction;
	const double inverse = 1 / (glm::dot(direction, shared) + variance);
	state_.bias += shared * (error * inverse);
	state_.biasCovariance -= glm::outerProduct(shared, shared * inverse);
}

} // namespace arift
