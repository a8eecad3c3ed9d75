#include "core/io/osim/osim_forces_internal.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "core/angle.h"
#include "core/error.h"
#include "core/io/osim/osim_reader_internal.h"

namespace sinew {
namespace osim {
namespace {

static_assert(kLargestPassiveExponent == 10, "the expression says 10");

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// M exp(x), straight on from x = 10.
std::string term(double moment_Nm, double rate_per_rad, const std::string& difference) {
  const std::string x = digits(rate_per_rad) + "*(" + difference + ")";
  return digits(moment_Nm) + "*exp(min(10," + x + "))*(1+max(0," + x + "-10))";
}

/// First figures of a term; the rest is checked by writing it again.
bool readTerm(const char* text, const char* format, double& moment_Nm, double& rate_per_rad, double& angle_rad) {
  return std::sscanf(text, format, &moment_Nm, &rate_per_rad, &angle_rad) == 3;
}

}  // namespace

std::string expressionOf(const PassiveMoment& m) {
  std::string text;
  if (m.lower_Nm > 0) text += term(m.lower_Nm, m.lower_rate_per_rad, digits(m.lower_rad) + "-q");
  if (m.upper_Nm > 0) text += "-" + term(m.upper_Nm, m.upper_rate_per_rad, "q-" + digits(m.upper_rad));
  require(!text.empty(), "an expression of structures that are there");
  return text;
}

std::optional<PassiveMoment> passiveMomentOf(std::string expression) {
  std::erase_if(expression, [](unsigned char c) { return std::isspace(c); });
  PassiveMoment m;
  const std::size_t upper = expression.find("))-");
  const bool both = upper != std::string::npos && !expression.starts_with('-');
  if (!expression.starts_with('-') &&
      !readTerm(expression.c_str(), "%lf*exp(min(10,%lf*(%lf-q", m.lower_Nm, m.lower_rate_per_rad, m.lower_rad))
    return std::nullopt;
  if ((both || expression.starts_with('-')) &&
      !readTerm(expression.c_str() + (both ? upper + 3 : 1), "%lf*exp(min(10,%lf*(q-%lf", m.upper_Nm,
                m.upper_rate_per_rad, m.upper_rad))
    return std::nullopt;
  if (!(m.lower_Nm > 0 || m.upper_Nm > 0) || expressionOf(m) != expression) return std::nullopt;
  return m;
}

}  // namespace osim

/// True if it was read; what is no force of ours or OpenSim's limit is left to the caller to name.
bool OsimReader::readCoordinateForce(const XmlElement& force) {
  ForeignCoordinateForce result{force.name(), -1, {}};
  const auto coordinateOf = [&] {
    const XmlElement name = force["coordinate"];
    return coordinate(name, name.text());
  };
  if (const auto applies = force.findAny({"appliesForce"}); applies && !applies->boolean()) return false;
  if (force.tag() == "ExpressionBasedCoordinateForce") {
    const auto moment = osim::passiveMomentOf(force["expression"].text());
    if (!moment) return false;
    result.coordinate = coordinateOf();
    result.law = *moment;
  } else if (force.tag() == "CoordinateLimitForce") {
    result.coordinate = coordinateOf();
    const double unit =
        model_.coordinates[static_cast<std::size_t>(result.coordinate)].translational ? 1 : kRadPerDeg;
    const auto value = [&](const char* tag, double otherwise) {
      const auto element = force.find(tag);
      return element ? element->number() : otherwise;
    };
    // What is not named has OpenSim's default.
    result.law = CoordinateLimit{.upper = unit * value("upper_limit", 0),
                                 .upper_stiffness = value("upper_stiffness", 1) / unit,
                                 .lower = unit * value("lower_limit", 0),
                                 .lower_stiffness = value("lower_stiffness", 1) / unit,
                                 .transition = unit * value("transition", 0.1)};
  } else {
    return false;
  }
  model_.coordinate_forces.push_back(std::move(result));
  return true;
}

}  // namespace sinew
