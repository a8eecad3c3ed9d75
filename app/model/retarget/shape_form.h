#pragma once
#include <QString>
#include <array>
#include <string>
#include <vector>

#include "core/skeleton/shape/shape.h"

namespace sinew {

/// One line of the shape form: a parameter of the midline, or one that each side has.
struct ShapeField {
  std::string part;      ///< "femur"
  std::string quantity;  ///< "elongation"
  /// Places in toVector(): right, left; of the midline the first alone, the second is -1.
  std::array<int, 2> place{-1, -1};
  bool isSided() const { return place[1] >= 0; }
  ShapeUnit unit() const;
};

/// All parameters, part by part as a person looks for them: trunk, pelvis, hip, neck, head, thigh, shank, foot, ...
const std::vector<ShapeField>& shapeFields();

QString partTitle(const std::string& part);     ///< "Femur"
QString fieldTitle(const ShapeField& field);    ///< "Neck-shaft angle"
QString fieldMeaning(const ShapeField& field);  ///< a sentence for the tool tip, units and sign included

/// What is shown: a ratio, degrees, or millimetres.
double shownValue(const ShapeParameters& shape, const ShapeField& field, int side);
/// With `linked` both sides. A value that no body can have is answered by validate(), not here.
void setShownValue(ShapeParameters& shape, const ShapeField& field, int side, bool linked, double shown);
/// Whether every sided parameter is the same on both sides.
bool hasEqualSides(const ShapeParameters& shape);
/// The left side becomes what the right one is.
void mirrorToLeft(ShapeParameters& shape);

/// What a slider offers; beyond it a value can be typed, up to the bounds of validate().
struct ShownRange {
  double low, high;
};
ShownRange sliderRange(const ShapeField& field);
ShownRange typedRange(const ShapeField& field);

/// "dwarf: trunk elongation 2.00, ...": what differs from the reference, in one line; empty if nothing does.
QString shapeInWords(const ShapeParameters& shape);

}  // namespace sinew
