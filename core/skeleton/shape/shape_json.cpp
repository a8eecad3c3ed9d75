#include "core/skeleton/shape/shape_json.h"

#include <algorithm>

#include "core/skeleton/shape/population.h"
#include "core/text.h"

namespace sinew {
namespace {

/// Name of a parameter in files: angles carry their unit.
std::string fileName(const std::string& parameter) {
  return isShapeAngle(parameter) ? parameter + "_rad" : parameter;
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
  std::vector<double> values;
  for (const auto& parameter : shapeParameterNames()) {
    names.push_back(fileName(parameter));
    values.push_back(json[names.back()].number());
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
