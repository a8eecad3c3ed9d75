#include "app/model/explorer/muscle_text.h"

#include <cmath>

#include "app/model/stage_text.h"
#include "core/angle.h"
#include "core/muscle/hill.h"
#include "core/muscle/muscle_path.h"
#include "core/posture/muscle_role.h"
#include "core/skeleton/clinical_angles.h"
#include "core/skeleton/motion_words.h"
#include "core/text.h"

namespace sinew {
namespace {

constexpr double kSpecificTension_Npcm2 = 60;  // what the published F_max are made with (Rajagopal 2016)

QString tr(const char* text) {
  return QObject::tr(text);
}

QString placeOf(const PathPoint& point) {
  const QString bone = readableName(point.bone).section(',', 0, 0), site = QString::fromStdString(point.site);
  return site.isEmpty() ? bone : bone + ": " + site;
}

CardSection attachments(const MusculotendonUnit& unit) {
  CardSection section{tr("Path"), {}};
  int via = 0;
  for (const auto& point : unit.path) {
    const QString label = point.role == PathPointRole::Origin      ? tr("Origin")
                          : point.role == PathPointRole::Insertion ? tr("Insertion")
                                                                   : tr("Via point %1").arg(++via);
    section.lines.emplace_back(label, placeOf(point));
  }
  return section;
}

CardSection actions(const Explorer& explorer, int index) {
  const Skeleton& skeleton = explorer.model()->skeleton;
  CardSection section{tr("Turns, in this posture"), {}};
  for (const auto& action : muscleActions(explorer.evaluation(), index)) {
    const auto& name = skeleton.coordinates[std::size_t(action.coordinate)].name;
    section.lines.emplace_back(readableName(motionWords(name, action.moment_arm_m > 0)),
                               tr("%1 cm").arg(figure(100 * std::abs(action.moment_arm_m), 1)));
  }
  if (section.lines.empty()) section.lines.emplace_back(QString{}, tr("No moment arm above 1 mm"));
  return section;
}

CardSection functions(const Explorer& explorer, const MusculotendonUnit& unit) {
  CardSection section{tr("Shortens in"), {}};
  for (const auto& f : muscleFunctions(explorer.model()->skeleton, unit, explorer.motions()))
    section.lines.emplace_back(
        tr("%1, %2 to %3°")
            .arg(readableName(f.motion->title), figure(f.motion->start_deg, 0), figure(f.motion->end_deg, 0)),
        tr("%1 mm").arg(figure(1000 * f.shortening_m, 0)));
  if (section.lines.empty()) section.lines.emplace_back(QString{}, tr("None of the named joint motions"));
  return section;
}

CardSection parameters(const Model& model, const MusculotendonUnit& unit) {
  CardSection section{
      tr("Parameters"),
      {{tr("Maximal isometric force"), figure(unit.max_isometric_force_N, 0) + " N"},
       {tr("Cross-section (PCSA), at %1 N/cm²").arg(kSpecificTension_Npcm2),
        figure(unit.max_isometric_force_N / kSpecificTension_Npcm2, 1) + " cm²"},
       {tr("Optimal fibre length"), figure(1000 * unit.optimal_fiber_length_m, 1) + " mm"},
       {tr("Tendon slack length"), figure(1000 * unit.tendon_slack_length_m, 1) + " mm"},
       {tr("Pennation at optimal length"), figure(unit.pennation_angle_at_optimal_rad / kRadPerDeg, 1) + "°"}}};
  if (const auto factor = model.length_factors.find(unit.name); factor != model.length_factors.end())
    section.lines.emplace_back(tr("Length factor of the examination"), figure(factor->second, 3));
  section.lines.emplace_back(tr("Source"), QString::fromStdString(unit.source));
  return section;
}

CardSection state(const Explorer& explorer, const MusculotendonUnit& unit, int index) {
  const PostureEvaluation& e = explorer.evaluation();
  const double length_m = e.length_m[index], margin_m = longestLength_m(unit) - length_m;
  CardSection section{
      tr("In this posture"),
      {{tr("Length of the path"), figure(1000 * length_m, 1) + " mm"},
       {tr("Fibre length / optimal, passive"), figure(e.normalized_fiber_length[index], 2)},
       {tr("Passive force"), tr("%1 N (%2 %)")
                                 .arg(figure(e.passive_force_N[index], 0),
                                      figure(100 * e.passive_force_N[index] / unit.max_isometric_force_N, 1))},
       {margin_m >= 0 ? tr("To spare to the longest length") : tr("Beyond the longest length by"),
        figure(1000 * std::abs(margin_m), 1) + " mm"}}};
  if (const double a = explorer.activation()[std::size_t(index)]; a > 0)
    section.lines.emplace_back(tr("Force at %1 % activation").arg(figure(100 * a, 0)),
                               figure(equilibrium(unit, length_m, a).force_N, 0) + " N");
  return section;
}

QString nameOf(const Model& model, int unit) {
  return readableName(model.musculature.units[std::size_t(unit)].name);
}

/// "a", "a and b", "a and 3 more".
QString firstAndRest(const QStringList& names) {
  if (names.size() <= 2) return names.join(tr(" and "));
  return tr("%1 and %2 more").arg(names.front()).arg(names.size() - 1);
}

}  // namespace

std::vector<CardSection> muscleCard(const Explorer& explorer, int unit) {
  const Model& model = *explorer.model();
  const MusculotendonUnit& u = model.musculature.units[std::size_t(unit)];
  QStringList joints;
  const auto spanned = spannedCoordinates(u, clinicalKinematics(model.skeleton, explorer.posture()));
  for (const int joint : crossedJoints(model.skeleton, spanned))
    joints << readableName(model.skeleton.joints[std::size_t(joint)].name).section(',', 0, 0);
  CardSection path = attachments(u);
  path.lines.emplace_back(tr("Joints crossed"), joints.join(", "));
  return {state(explorer, u, unit), actions(explorer, unit), functions(explorer, u), std::move(path),
          parameters(model, u)};
}

QString motionTitle(const JointMotion& motion) {
  const QString side = sideName(motion.name.ends_with("_l") ? "l" : motion.name.ends_with("_r") ? "r" : "");
  const QString title = readableName(motion.title);
  return side.isEmpty() ? title : title + ", " + side;
}

QString actionText(const Skeleton& skeleton, int coordinate, double moment_arm_m) {
  return tr("%1 %2 cm")
      .arg(QString::fromStdString(motionWords(skeleton.coordinates[std::size_t(coordinate)].name, moment_arm_m > 0)),
           figure(100 * std::abs(moment_arm_m), 1));
}

QString validityText(const Model& model, const PostureEvaluation& evaluation) {
  QStringList beyond_envelope;
  for (const auto& name : evaluation.coordinates_beyond_envelope)
    beyond_envelope << readableName(name).replace(", ", " ");
  QStringList stretched;
  for (const auto& m : evaluation.margins)
    if (m.margin_m < 0) stretched << nameOf(model, m.unit);
  if (evaluation.valid)
    return evaluation.margins.empty() ? tr("Possible posture.")
                                      : tr("Possible posture. Least to spare: %1 mm, %2.")
                                            .arg(figure(1000 * evaluation.margins.front().margin_m, 1),
                                                 nameOf(model, evaluation.margins.front().unit));
  QString text = tr("Impossible posture.");
  if (!stretched.isEmpty())
    text += ' ' + tr("%1: %2 mm beyond its longest length%3.")
                      .arg(stretched.front(), figure(-1000 * evaluation.margins.front().margin_m, 1),
                           stretched.size() > 1 ? tr(", and %1 more").arg(stretched.size() - 1) : QString{});
  if (!beyond_envelope.isEmpty())
    text += ' ' + tr("Beyond the joint's envelope: %1.").arg(firstAndRest(beyond_envelope));
  return text;
}

QString rangeText(const Model& model, const Coordinate& coordinate, const CoordinateRange& range) {
  if (range.isEmpty())
    return range.high_unit < 0 ? tr("Muscles leave no angle free")
                               : tr("Muscles leave no angle free: %1").arg(nameOf(model, range.high_unit));
  const auto held = [&](int unit) { return unit < 0 ? tr("joint") : nameOf(model, unit).section(',', 0, 0); };
  const auto sided = [&](int unit) {  // the other side's name only where it is not the joint's own
    if (unit < 0 || sideSign(model.musculature.units[std::size_t(unit)].name) == sideSign(coordinate.name))
      if (coordinate.name != withoutSide(coordinate.name)) return held(unit);
    return unit < 0 ? held(unit) : nameOf(model, unit);
  };
  return tr("Free %1° (%2) to %3° (%4)")
      .arg(figure(range.low_rad / kRadPerDeg, 0), sided(range.low_unit), figure(range.high_rad / kRadPerDeg, 0),
           sided(range.high_unit));
}

FoundMuscles findMuscles(const Musculature& musculature, const QString& wanted) {
  const QStringList words = wanted.simplified().split(' ', Qt::SkipEmptyParts);
  FoundMuscles found;
  std::vector<std::string> names;
  for (int i = 0; i < int(musculature.units.size()); ++i) {
    const auto& unit = musculature.units[std::size_t(i)];
    const QString text = readableName(unit.name) + ' ' + readableName(unit.group) + ' ' +
                         QString::fromStdString(unit.name + ' ' + unit.group);
    const bool all =
        std::ranges::all_of(words, [&](const QString& w) { return text.contains(w, Qt::CaseInsensitive); });
    if (all) found.units.push_back(i);
    names.push_back(unit.name);
  }
  found.nearest = found.units.empty();
  if (!found.nearest) return found;
  constexpr std::size_t kNearest = 6;
  const std::string asked = wanted.simplified().replace(' ', '_').toLower().toStdString();
  for (const auto& name : nearestNames(asked, names, kNearest)) found.units.push_back(musculature.unitIndex(name));
  return found;
}

}  // namespace sinew
