#include "runtime/tracking/magnetic_heading.h"
#include <algorithm>

namespace arift
{

MagneticCoefficients::MagneticCoefficients(const MagneticParameters &parameters, double samplePeriod)
	: period(samplePeriod),
	  gain(1 - std::exp(-samplePeriod / parameters.tau)),
	  referenceGain(1 - std::exp(-samplePeriod / parameters.referenceTau)),
	  current(parameters.currentTau, samplePeriod)
{
}

MagneticHeading::MagneticHeading(double samplePeriod, const MagneticParameters &parameters)
	: parameters_(parameters), coefficients_(parameters, samplePeriod)
{
	state_.rejectedFor = parameters.longestRejection;
}

void MagneticHeading::update(const glm::dvec3 &fieldInEarth, double turn, double period)
{
	const double norm = glm::length(fieldInEarth);
	if (!(norm > 0) || !std::isfinite(norm) || !(period > 0)) return;
	if (std::abs(period - coefficients_.period) > 1e-3 * period) coefficients_ = MagneticCoefficients(parameters_, period);
	const double dip = -std::asin(std::clamp(fieldInEarth.z / norm, -1.0, 1.0));
	if (!state_.started) state_.current.settle({norm, dip});
	state_.started = true;
	const auto [smoothNorm, smoothDip] = state_.current.step({norm, dip}, coefficients_.current);
	state_.norm = smoothNorm;
	state_.dip = smoothDip;
	judge(turn);
	constexpr double whole = 6.283185307179586;
	const double error = std::remainder(std::atan2(fieldInEarth.x, fieldInEarth.y) - state_.heading, whole);
	state_.heading = std::remainder(state_.heading + gain() * error, whole);
}

/// Whether norm and dip are the reference's, and whether another field has lasted long enough to become the reference.
void MagneticHeading::judge(double turn)
{
	MagneticState &s = state_;
	const auto agrees = [&](double norm, double dip) {
		return std::abs(s.norm - norm) < parameters_.normThreshold * norm && std::abs(s.dip - dip) < parameters_.dipThreshold;
	};
	const auto follow = [&](double &norm, double &dip) {
		norm += coefficients_.referenceGain * (s.norm - norm);
		dip += coefficients_.referenceGain * (s.dip - dip);
	};
	if (agrees(s.referenceNorm, s.referenceDip)) {
		s.undisturbedFor += coefficients_.period;
		if (s.undisturbedFor >= parameters_.undisturbedTime) {
			s.disturbed = false;
			follow(s.referenceNorm, s.referenceDip);
		}
	} else {
		s.undisturbedFor = 0;
		s.disturbed = true;
	}
	if (!agrees(s.candidateNorm, s.candidateDip)) {
		s.candidateFor = 0;
		s.candidateNorm = s.norm;
		s.candidateDip = s.dip;
		return;
	}
	if (turn >= parameters_.newTurn) s.candidateFor += coefficients_.period;
	follow(s.candidateNorm, s.candidateDip);
	const double needed = s.referenceNorm == 0 ? parameters_.newFirstTime : parameters_.newTime;
	if (s.disturbed && s.candidateFor >= needed) {
		s.referenceNorm = s.candidateNorm;
		s.referenceDip = s.candidateDip;
		s.disturbed = false;
		s.undisturbedFor = parameters_.undisturbedTime;
	}
}

double MagneticHeading::gain()
{
	MagneticState &s = state_;
	double gain = coefficients_.gain;
	if (!s.disturbed) {
		s.rejectedFor = std::max(0.0, s.rejectedFor - parameters_.rejectionFactor * coefficients_.period);
	} else if (s.rejectedFor <= parameters_.longestRejection) {
		s.rejectedFor += coefficients_.period;
		gain = 0;
	} else {
		gain /= parameters_.rejectionFactor;
	}
	if (s.startGain > 0) {
		gain = std::max(gain, s.startGain);
		s.startGain /= s.startGain + 1;
		if (s.startGain * parameters_.tau < coefficients_.period) s.startGain = 0;
	}
	return gain;
}

} // namespace arift
