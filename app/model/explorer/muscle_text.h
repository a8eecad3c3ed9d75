#pragma once
#include <QString>
#include <utility>
#include <vector>

#include "app/model/explorer/explorer.h"

namespace sinew {

/// One heading of a muscle's card and its lines.
struct CardSection {
  QString heading;
  std::vector<std::pair<QString, QString>> lines;  ///< label, value; a line of plain words has an empty label
};

/// Everything that the card says of a unit in the explorer's present posture.
std::vector<CardSection> muscleCard(const Explorer& explorer, int unit);

/// "hip flexion", "hip flexion, left": a joint motion for a list.
QString motionTitle(const JointMotion& motion);
/// "knee flexion 4.1 cm".
QString actionText(const Skeleton& skeleton, int coordinate, double moment_arm_m);

/// Whether the posture can be taken, in one sentence: the least length to spare, or what fails first and by how much.
QString validityText(const Model& model, const PostureEvaluation& evaluation);
/// "Muscles: -31 to 112 deg, held by iliacus | semimembranosus".
QString rangeText(const Model& model, const Coordinate& coordinate, const CoordinateRange& range);

struct FoundMuscles {
  std::vector<int> units;
  bool nearest = false;  ///< none has the words: these have the nearest names
};
/// Units whose name or group has every word of `wanted`, in the model's order; all for an empty search.
FoundMuscles findMuscles(const Musculature& musculature, const QString& wanted);

}  // namespace sinew
