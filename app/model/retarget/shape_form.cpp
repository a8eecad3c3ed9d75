#include "app/model/retarget/shape_form.h"

#include <algorithm>
#include <cmath>

#include "app/model/stage_text.h"
#include "core/angle.h"

namespace sinew {
namespace {

constexpr const char* kParts[] = {"trunk", "pelvis", "hip",     "neck", "head", "femur",
                                  "tibia", "foot",   "humerus", "ulna", "hand"};

/// Units of the radians and metres that a shape is made of, as shown.
double shownUnit(ShapeUnit unit) {
  return unit == ShapeUnit::Angle ? kRadPerDeg : unit == ShapeUnit::Length ? 1e-3 : 1;
}

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

ShapeUnit ShapeField::unit() const {
  return shapeUnit(part + '.' + quantity);
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
  if (part == "hip") return tr("Hip (head in its socket)");
  if (part == "ulna") return tr("Forearm (ulna)");
  return readableName(part);
}

QString fieldTitle(const ShapeField& field) {
  const std::string& q = field.quantity;
  if (q == "elongation") return tr("Length");
  if (q == "proximal_scale") return tr("Upper end");
  if (q == "distal_scale") return tr("Lower end");
  if (q == "neck_shaft") return tr("Neck-shaft");
  if (q == "varus") return field.part == "tibia" ? tr("Upper varus") : tr("Knee varus");
  if (q == "procurvatum") return field.part == "tibia" ? tr("Upper procurv.") : tr("Knee procurv.");
  if (q == "neck_length") return tr("Neck length");
  if (q == "neck_varus") return tr("Neck varus");
  if (q == "neck_retroversion") return tr("Neck retrov.");
  if (q == "bow_frontal") return tr("Bow, frontal");
  if (q == "bow_sagittal") return tr("Bow, sagittal");
  if (q == "distal_varus") return tr("Ankle varus");
  if (q == "distal_procurvatum") return tr("Ankle procurv.");
  if (q == "lateral") return tr("Outwards");
  if (q == "superior") return tr("Upwards");
  if (q == "anterior") return tr("Forwards");
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
  const bool tibia = field.part == "tibia";
  if (q == "neck_shaft")
    text = tr("Added angle between neck and shaft below the trochanters, degrees; positive is valgus");
  if (q == "varus")
    text = tibia ? tr("Frontal bend just below the knee, degrees; positive is varus (tibia vara)")
                 : tr("Added frontal angle just above the knee, degrees; positive is varus");
  if (q == "procurvatum")
    text = tibia ? tr("Sagittal bend just below the knee, degrees; positive has its apex in front")
                 : tr("Sagittal bend just above the knee, degrees; positive has its apex in front");
  if (q == "neck_length") text = tr("Added length of the neck, mm; negative is a short neck");
  if (q == "neck_varus") text = tr("Bend in the neck itself, degrees; positive puts the head lower (coxa vara)");
  if (q == "neck_retroversion") text = tr("Bend in the neck itself, degrees; positive puts the head further behind");
  if (q == "bow_frontal") text = tr("Bow of the shaft in the frontal plane, degrees; positive has its apex outwards");
  if (q == "bow_sagittal")
    text = tr("Bow of the shaft in the sagittal plane, degrees; positive has its apex in front");
  if (q == "distal_varus") text = tr("Frontal bend just above the ankle, degrees; positive is varus");
  if (q == "distal_procurvatum")
    text = tr("Sagittal bend just above the ankle, degrees; positive has its apex in front");
  if (q == "lateral") text = tr("How far the head's centre stands outwards of the socket's, mm");
  if (q == "superior") text = tr("How far the head's centre stands above the socket's, mm");
  if (q == "anterior") text = tr("How far the head's centre stands in front of the socket's, mm");
  if (q == "expansion") text = tr("Width and depth of the trunk, relative to the reference");
  if (q == "bend") text = tr("Curve of the trunk, degrees; positive is forward");
  if (q == "scale") text = tr("Size in all directions, relative to the reference");
  if (text.isEmpty()) text = readableName(q) + tr(", relative to the reference");
  return partTitle(field.part) + ": " + text;
}

double shownValue(const ShapeParameters& shape, const ShapeField& field, int side) {
  const double value = toVector(shape)[std::size_t(field.place[std::size_t(field.isSided() ? side : 0)])];
  return value / shownUnit(field.unit());
}

void setShownValue(ShapeParameters& shape, const ShapeField& field, int side, bool linked, double shown) {
  auto values = toVector(shape);
  const double value = shown * shownUnit(field.unit());
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
  const std::string& q = field.quantity;
  switch (field.unit()) {
    case ShapeUnit::Ratio:
      return {0.4, 3};
    case ShapeUnit::Length:
      return q == "neck_length" ? ShownRange{-20, 20} : ShownRange{-60, 60};
    case ShapeUnit::Angle:
      break;
  }
  if (q == "bend") return {-40, 40};
  if (q == "torsion") return {-60, 60};
  return {-30, 30};
}

ShownRange typedRange(const ShapeField& field) {
  const double unit = shownUnit(field.unit());
  switch (field.unit()) {
    case ShapeUnit::Angle:
      return {-kGreatestShapeAngle_rad / unit, kGreatestShapeAngle_rad / unit};
    case ShapeUnit::Length:
      return {-kGreatestShapeLength_m / unit, kGreatestShapeLength_m / unit};
    case ShapeUnit::Ratio:
      break;
  }
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
      const QString number = field.unit() == ShapeUnit::Angle    ? figure(value, 0) + QStringLiteral("°")
                             : field.unit() == ShapeUnit::Length ? figure(value, 0) + QStringLiteral(" mm")
                                                                 : figure(value, 2);
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
