#include "core/skeleton/shape/shape_json.h"

#include <algorithm>

#include "core/skeleton/shape/population.h"
#include "core/skeleton/skeleton.h"
#include "core/text.h"

namespace sinew {
namespace {

/// Name of a parameter in files: angles and lengths carry their unit.
std::string fileName(const std::string& parameter) {
  switch (shapeUnit(parameter)) {
    case ShapeUnit::Angle:
      return parameter + "_rad";
    case ShapeUnit::Length:
      return parameter + "_m";
    case ShapeUnit::Ratio:
      break;
  }
  return parameter;
}

/// Parameters that older files do not have: there they are neutral.
bool isAddedLater(const std::string& parameter) {
  const auto dot = parameter.find('.');
  const std::string_view part = withoutSide(std::string_view{parameter}.substr(0, dot));
  const std::string_view quantity = std::string_view{parameter}.substr(dot + 1);
  if (part == "hip") return true;
  if (part == "tibia") return quantity.ends_with("varus") || quantity.ends_with("procurvatum");
  return part == "femur" && (quantity == "procurvatum" || quantity.starts_with("bow_") || quantity == "neck_length" ||
                             quantity == "neck_varus" || quantity == "neck_retroversion");
}

}  // namespace

Json shapeToJson(const ShapeParameters& shape) {
  Json json = Json::object();
  const auto values = toVector(shape);
  for (std::size_t i = 0; i < values.size(); ++i) json[fileName(shapeParameterNames()[i])] = values[i];
  return json;
}

ShapeParameters shapeFromJson(const JsonReader& json) {
  std::vector<std::string> names;
  std::vector<double> values = toVector(ShapeParameters{});
  for (std::size_t i = 0; i < values.size(); ++i) {
    names.push_back(fileName(shapeParameterNames()[i]));
    if (isAddedLater(shapeParameterNames()[i]) && !json.find(names.back())) continue;
    values[i] = json[names.back()].number();
  }
  for (const auto& [name, value] : json.members())
    if (std::ranges::find(names, name) == names.end())
      value.fail("a shape parameter", "'" + name + "'" + didYouMean(name, names));
  const ShapeParameters shape = shapeFromVector(values);
  try {
    validate(shape);
  } catch (const InputError& error) {
    json.fail(error.detail().field + ": " + error.detail().expected, error.detail().found);
  }
  return shape;
}

}  // namespace sinew
