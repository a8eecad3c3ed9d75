#include "app/model/retarget/shape_form.h"

#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "core/angle.h"

namespace sinew {
namespace {

constexpr const char* kParts[] = {"trunk", "pelvis", "neck",    "head", "femur",
                                  "tibia", "foot",   "humerus", "ulna", "hand"};

QString tr(const char* text) {
  return QString::fromUtf8(text);
}

ShapeField fieldOf(const std::string& name, int place) {
  const auto dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1), {place, -1}};
}

std::string otherSide(std::string name) {
  name.replace(name.find("_r."), 3, "_l.");
  return name;
}

}  // namespace

bool ShapeField::isAngle() const {
  return quantity == "torsion" || quantity == "neck_shaft" || quantity == "varus" || quantity == "bend";
}

const std::vector<ShapeField>& shapeFields() {
  static const std::vector<ShapeField> fields = [] {
    const auto& names = shapeParameterNames();
    std::vector<ShapeField> all;
    for (int i = 0; i < int(names.size()); ++i) {
      const std::string& name = names[std::size_t(i)];
      if (name.find("_l.") != std::string::npos) continue;
      ShapeField field = fieldOf(name, i);
      if (name.find("_r.") != std::string::npos) {
        field.part.resize(field.part.size() - 2);
        field.place[1] = int(std::ranges::find(names, otherSide(name)) - names.begin());
      }
      all.push_back(field);
    }
    const auto rank = [](const ShapeField& f) { return std::ranges::find(kParts, f.part) - std::begin(kParts); };
    std::ranges::stable_sort(all, {}, rank);
    return all;
  }();
  return fields;
}

QString partTitle(const std::string& part) {
  if (part == "femur") return tr("Thigh (femur)");
  if (part == "tibia") return tr("Shank (tibia)");
  if (part == "humerus") return tr("Upper arm (humerus)");
  if (part == "ulna") return tr("Forearm (ulna)");
  return readableName(part);
}

QString fieldTitle(const ShapeField& field) {
  const std::string& q = field.quantity;
  if (q == "elongation") return tr("Length");
  if (q == "proximal_scale") return tr("Upper end");
  if (q == "distal_scale") return tr("Lower end");
  if (q == "neck_shaft") return tr("Neck-shaft");
  if (q == "varus") return tr("Knee varus");
  if (q == "expansion") return tr("Girth");
  if (q == "bend") return tr("Forward bend");
  if (q == "scale") return tr("Size");
  return readableName(q);
}

QString fieldMeaning(const ShapeField& field) {
  const std::string& q = field.quantity;
  QString text;
  if (q == "elongation") text = tr("Length between the joint centres, relative to the reference");
  if (q == "proximal_scale") text = tr("Size of the end nearer to the trunk, relative to the reference");
  if (q == "distal_scale") text = tr("Size of the end away from the trunk, relative to the reference");
  if (q == "torsion") text = tr("Added torsion of the shaft, degrees; positive turns the lower end outwards");
  if (q == "neck_shaft") text = tr("Added angle between neck and shaft, degrees; positive is valgus");
  if (q == "varus") text = tr("Added frontal angle of the knee, degrees; positive is varus");
  if (q == "expansion") text = tr("Width and depth of the trunk, relative to the reference");
  if (q == "bend") text = tr("Curve of the trunk, degrees; positive is forward");
  if (q == "scale") text = tr("Size in all directions, relative to the reference");
  if (text.isEmpty()) text = readableName(q) + tr(", relative to the reference");
  return partTitle(field.part) + ": " + text;
}

double shownValue(const ShapeParameters& shape, const ShapeField& field, int side) {
  const double value = toVector(shape)[std::size_t(field.place[std::size_t(field.isSided() ? side : 0)])];
  return field.isAngle() ? value / kRadPerDeg : value;
}

void setShownValue(ShapeParameters& shape, const ShapeField& field, int side, bool linked, double shown) {
  auto values = toVector(shape);
  const double value = field.isAngle() ? shown * kRadPerDeg : shown;
  for (int s = 0; s < (field.isSided() ? 2 : 1); ++s)
    if (linked || !field.isSided() || s == side) values[std::size_t(field.place[std::size_t(s)])] = value;
  shape = shapeFromVector(values);
}

bool hasEqualSides(const ShapeParameters& shape) {
  return shape.sides[0] == shape.sides[1];
}

void mirrorToLeft(ShapeParameters& shape) {
  shape.sides[1] = shape.sides[0];
}

ShownRange sliderRange(const ShapeField& field) {
  if (field.quantity == "bend") return {-40, 40};
  if (field.quantity == "neck_shaft" || field.quantity == "varus") return {-30, 30};
  if (field.isAngle()) return {-60, 60};
  return {0.4, 3};
}

ShownRange typedRange(const ShapeField& field) {
  if (field.isAngle()) return {-kGreatestShapeAngle_rad / kRadPerDeg, kGreatestShapeAngle_rad / kRadPerDeg};
  return {kLeastShapeRatio, kGreatestShapeRatio};
}

QString shapeInWords(const ShapeParameters& shape) {
  QStringList words;
  const ShapeParameters human;
  for (const ShapeField& field : shapeFields()) {
    const double right = shownValue(shape, field, 0), left = shownValue(shape, field, 1);
    const double neutral = shownValue(human, field, 0);
    const auto say = [&](const QString& side, double value) {
      if (std::abs(value - neutral) < 1e-9) return;
      const QString number =
          figure(value, field.isAngle() ? 0 : 2) + (field.isAngle() ? QStringLiteral("°") : QString{});
      words << QStringLiteral("%1%2 %3 %4")
                   .arg(readableName(field.part).toLower(), side, fieldTitle(field).toLower(), number);
    };
    if (field.isSided() && right != left) {
      say(tr(" right"), right);
      say(tr(" left"), left);
    } else {
      say({}, right);
    }
  }
  return words.join(", ");
}

}  // namespace sinew
