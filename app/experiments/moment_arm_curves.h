#pragma once
#include <span>
#include <string>
#include <vector>

#include "app/experiments/characters.h"

namespace sinew {

class RetargetReference;

// Ryu et al., Moment Arm: how the moment arms of a muscle change with the body.

/// A muscle and a motion to look at.
struct MomentArmQuestion {
  std::string muscle, motion;  ///< muscle, unit or group of the right side; motion without side
};
/// The three of the paper's figure.
std::vector<MomentArmQuestion> paperMomentArms();
/// Everything on the right side that extends or flexes the hip of the reference, on average over the motion: muscle
/// is empty.
std::vector<MomentArmQuestion> hipMomentArms();

/// Moment arm of a muscle over a motion, positive = turns the motion's way [m]; units of one muscle averaged by their
/// maximal forces.
struct MomentArmCurve {
  std::string body;
  std::vector<double> arm_m;  ///< by angle
  double mean_m = 0;
};

struct MomentArmFigure {
  MomentArmQuestion question;
  std::string title, coordinate;
  std::vector<double> angle_deg;
  std::vector<MomentArmCurve> curves;  ///< reference first, then the bodies
};

MomentArmFigure momentArmFigure(const RetargetReference& reference, std::span<const Character> characters,
                                const MomentArmQuestion& question, int samples = 41);

}  // namespace sinew
