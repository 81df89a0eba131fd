// Which way the head points: a filter of the VQF class after Laidig & Seel, "VQF: Highly accurate IMU orientation estimation with bias
// estimation and magnetic disturbance rejection", Information Fusion 91 (2023). What differs, for a head: the inclination correction is as
// slow as the gyroscope is trustworthy (walking is sustained acceleration), and the bias has a wide prior until the first rest.
#pragma once
#include "runtime/tracking/low_pass.h"
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace arift
{

constexpr double degree = 0.017453292519943295; ///< in radians

/// What may be tuned. Seconds, radians, m/s^2. Names after the paper, table 1, where it has them.
struct OrientationParameters {
	double tauAcceleration = 14;        ///< of the inclination correction while the gyroscope is at its best
	double tauAccelerationStart = 0.05; ///< at the first sample; from then on no longer than the filter has run
	double tauAccelerationRest = 2;     ///< while resting: there is nothing but gravity
	double trustedTurn = 60 * degree;   ///< rad/s: a mean rate of turn at which scale errors halve tau
	double trustedBias = 0.7 * degree;  ///< rad/s: a persistent disagreement of rates and acceleration that halves tau
	double biasErrorTau = 3;            ///< over which it is told from passing acceleration
	double meanTurnTau = 5;             ///< of the mean rate of turn

	double biasSigmaInit = 3 * degree;     ///< rad/s
	double biasForgettingTime = 100;       ///< in which the bias is thought to wander by 0.1 degree/s
	double biasSigmaMotion = 0.4 * degree; ///< rad/s: what motion tells at best; large, so that translation does not leak into heading
	double biasPersistence = 5;            ///< how much more it is believed where it has long said the same (factor at trustedBias)
	double biasSigmaRest = 0.03 * degree;  ///< rad/s: what rest tells at best
	double biasClipFirst = 25 * degree;    ///< rad/s, before the first rest: an uncalibrated MEMS gyroscope
	double biasClip = 2 * degree;          ///< rad/s around the bias of the last rest

	double restTime = 1.5;         ///< without motion, until it is rest
	double restTimeFirst = 3;      ///< the same while the bias would be larger than biasClip: it might be slow, steady turning
	double restTau = 0.5;          ///< of the means that motion is told from
	double restRate = 2 * degree;  ///< rad/s from the mean
	double restAcceleration = 0.5; ///< m/s^2 from the mean

	double gyroscopeRange = 34.9; ///< rad/s; a component at or above it may be anything
	double longestStep = 0.25;    ///< a longer one is a gap: what happened in it is not known
};

/// Everything that changes. Earth has z up; its heading is that of the almost inertial frame.
struct OrientationState {
	glm::dquat gyroscopeOnly{1, 0, 0, 0}; ///< IMU in the almost inertial frame: integrated rates
	glm::dquat inclination{1, 0, 0, 0};   ///< the almost inertial frame in earth: never turns about the vertical
	glm::dvec3 lastRate{0};               ///< rad/s, before bias
	double unbroken = 0;                  ///< seconds since the start, the last gap or (less 0.5) the last saturation
	bool settled = false;                 ///< an acceleration has been seen since
	double meanTurn = 0;                  ///< rad/s

	LowPass<3> acceleration; ///< in the almost inertial frame
	LowPass<8> rotation;     ///< the two level rows of IMU in earth and their products with the bias, delayed as the acceleration is
	LowPass<2> biasError;    ///< rad/s, level: what motion says about the bias
	double persistence = 0;  ///< the square of its length by that of trustedBias

	glm::dvec3 bias{0};           ///< rad/s
	glm::dmat3 biasCovariance{0}; ///< (rad/s)^2
	bool rested = false;          ///< ever
	glm::dvec3 restBias{0};       ///< at the last rest

	LowPass<3> restRate, restAcceleration;
	glm::dvec3 meanRate{0}; ///< rad/s, low-passed for rest
	double stillFor = 0;    ///< seconds
	bool resting = false;
};

/// What follows from parameters and sample period; variances of one sample's statement about the bias, (rad/s)^2.
struct OrientationCoefficients {
	OrientationCoefficients(const OrientationParameters &parameters, double samplePeriod);
	double period;
	LowPassCoefficients rest, biasError;
	double biasNoise, biasInitial, biasMotion, biasRest;
};

class OrientationFilter
{
public:
	explicit OrientationFilter(double samplePeriod, const OrientationParameters &parameters = {});

	/// One sample in IMU axes: angular velocity (rad/s) over the `period` seconds that end now, specific force (m/s^2). A rate that is not
	/// finite is replaced by the last one, an acceleration that is not is passed over, and so is a sample whose period is not positive.
	void update(const glm::dvec3 &rate, const glm::dvec3 &acceleration, double period);

	/// What has happened since the last sample is not known: heading stands, inclination is found anew.
	void interrupt();

	/// IMU in earth (z up). Heading is arbitrary, constant but for what bias and scale error remain.
	glm::dquat orientation() const { return state_.inclination * state_.gyroscopeOnly; }
	/// rad/s, to be taken from what the gyroscope says.
	glm::dvec3 bias() const { return state_.bias; }
	const OrientationState &state() const { return state_; }

private:
	void detectRest(const glm::dvec3 &rate, const glm::dvec3 &acceleration);
	double accelerationTau() const;
	glm::dvec3 correctInclination(const glm::dvec3 &acceleration, const LowPassCoefficients &lowPass);
	/// `period` is 0 at the first acceleration, which is no correction of an earlier one.
	void estimateBias(const glm::dvec3 &up, const LowPassCoefficients &lowPass, double period);
	void observeBias(const glm::dvec3 &direction, double error, double variance);
	double biasClip() const { return state_.rested ? parameters_.biasClip : parameters_.biasClipFirst; }

	OrientationParameters parameters_;
	OrientationCoefficients coefficients_;
	OrientationState state_;
};

} // namespace arift
