#include "core/skeleton/shape/shape_priors.h"

#include <algorithm>

#include "core/angle.h"
#include "core/file.h"
#include "core/skeleton/shape/population.h"
#include "core/strict_json.h"
#include "core/text.h"

namespace sinew {
namespace {

/// "femur.torsion" -> "femur_r.torsion", "femur_l.torsion"; names of the midline stay.
std::vector<std::string> parametersOf(const std::string& name) {
  const auto& known = shapeParameterNames();
  if (name == kSizePrior || std::ranges::count(known, name)) return {name};
  const auto dot = std::min(name.find('.'), name.size());
  std::vector<std::string> sides;
  for (const char* side : {"_r", "_l"}) {
    const std::string sided = name.substr(0, dot) + side + name.substr(dot);
    if (std::ranges::count(known, sided)) sides.push_back(sided);
  }
  return sides;
}

const char* unitOf(const std::string& parameter) {
  switch (shapeUnit(parameter)) {
    case ShapeUnit::Angle:
      return "deg";
    case ShapeUnit::Length:
      return "mm";
    case ShapeUnit::Ratio:
      break;
  }
  return "ratio";
}

void addPriors(const JsonReader& json, std::vector<ShapePrior>& priors) {
  json.allowOnly({"parameter", "unit", "mean", "sd", "verified", "source", "deformity"});
  const std::string name = json["parameter"].text();
  const auto parameters = parametersOf(name);
  if (parameters.empty()) json["parameter"].fail("a shape parameter" + didYouMean(name, shapeParameterNames()), name);
  const std::string given = json["unit"].oneOf({"ratio", "deg", "mm"}), needed = unitOf(parameters.front());
  if (given != needed) json["unit"].fail(needed + ", the unit of " + name);
  const double unit = needed == "deg" ? kRadPerDeg : needed == "mm" ? 1e-3 : 1;
  const double mean = unit * (needed == "ratio" ? json["mean"].numberIn(0.2, 4) : json["mean"].numberIn(-90, 90));
  const double sd = unit * json["sd"].positive();
  const auto deformity = json.find("deformity");
  const bool verified = json["verified"].boolean();
  for (const auto& parameter : parameters) {
    if (std::ranges::count(priors, parameter, &ShapePrior::parameter))
      json["parameter"].fail("one prior a parameter", name + " twice");
    priors.push_back({parameter, mean, sd, json["source"].text() + (verified ? "" : " (not verified)"),
                      deformity && deformity->boolean()});
  }
}

}  // namespace

std::vector<ShapePrior> loadShapePriors(const std::filesystem::path& resource_dir) {
  const auto file = resource_dir / "clinical" / "shape_priors.json";
  const Json document = parseJson(readFile(file), file.string());
  const JsonReader root{document, file.string()};
  root.expectFormat("sinew.shape_priors", 1);
  root.allowOnly({"format", "version", "about", "priors"});
  std::vector<ShapePrior> priors;
  for (const auto& entry : root["priors"].items()) addPriors(entry, priors);
  return priors;
}

}  // namespace sinew
