// Heading from the magnetic field, and when not to believe it (Laidig & Seel 2023, sections 3.3 and 3.7).
#pragma once
#include "runtime/tracking/low_pass.h"
#include "runtime/tracking/orientation_filter.h"

namespace arift
{

/// Seconds, radians; the field's own unit cancels.
struct MagneticParameters {
	double tau = 9;             ///< of the heading correction
	double currentTau = 0.05;   ///< of the norm and dip that are judged
	double referenceTau = 20;   ///< of the norm and dip they are judged by
	double normThreshold = 0.1; ///< relative
	double dipThreshold = 10 * degree;
	double newTime = 20, newFirstTime = 5; ///< of moving in another homogeneous field, until it is the reference
	double newTurn = 20 * degree;          ///< rad/s: moving
	double undisturbedTime = 0.5;          ///< of agreement, until the field is believed again
	double longestRejection = 60;          ///< then it counts, by half
	double rejectionFactor = 2;
};

struct MagneticState {
	double heading = 0;       ///< to be turned about the vertical after the filter's orientation
	double startGain = 1;     ///< the first headings are averaged
	double norm = 0, dip = 0; ///< now
	double referenceNorm = 0, referenceDip = 0;
	double candidateNorm = -1, candidateDip = 0, candidateFor = 0;
	double undisturbedFor = 0, rejectedFor = 0;
	bool disturbed = true;
	bool started = false;
	LowPass<2> current;
};

struct MagneticCoefficients {
	MagneticCoefficients(const MagneticParameters &parameters, double samplePeriod);
	double period;
	double gain, referenceGain;
	LowPassCoefficients current;
};

class MagneticHeading
{
public:
	explicit MagneticHeading(double samplePeriod, const MagneticParameters &parameters = {});

	/// The field in the filter's earth frame (z up), any unit, `period` seconds after the last; `turn` is the rate of turn, rad/s. A field
	/// that is not finite or is zero is passed over.
	void update(const glm::dvec3 &fieldInEarth, double turn, double period);
	/// How far to turn the filter's earth about z so that its y points to magnetic north; radians.
	double heading() const { return state_.heading; }
	bool disturbed() const { return state_.disturbed; }
	bool started() const { return state_.started; }

private:
	void judge(double turn);
	double gain();

	MagneticParameters parameters_;
	MagneticCoefficients coefficients_;
	MagneticState state_;
};

} // namespace arift
