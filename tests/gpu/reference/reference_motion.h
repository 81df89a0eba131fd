// Head motion as a function of time, exact: a head that turns at a constant rate about a pivot in the neck. For tests.
#pragma once
#include <Eigen/Geometry>

namespace arift::reference
{

/// Maps points of one frame into another: parent = turn * point + place.
struct Placement {
	Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
	Eigen::Vector3d place = Eigen::Vector3d::Zero();

	Eigen::Vector3d out(const Eigen::Vector3d &point) const { return turn * point + place; }
	Eigen::Vector3d in(const Eigen::Vector3d &point) const { return turn.conjugate() * (point - place); }
	Placement holding(const Placement &child) const { return {turn * child.turn, out(child.place)}; }
};

/// The head's axes at time zero, turned at `rate` (radians per second, axis in the parent frame); seconds.
struct ConstantTurn {
	Eigen::Quaterniond start = Eigen::Quaterniond::Identity();
	Eigen::Vector3d rate = Eigen::Vector3d::Zero();
	Eigen::Vector3d pivotInHead{0, -0.075, 0.0805};

	Placement head(double time) const
	{
		const double angle = rate.norm() * time;
		const Eigen::Quaterniond turned =
			rate.norm() == 0 ? start : Eigen::Quaterniond(Eigen::AngleAxisd(angle, rate.normalized())) * start;
		return {turned, pivotInHead - turned * pivotInHead};
	}
};

} // namespace arift::reference
