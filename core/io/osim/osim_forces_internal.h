#pragma once
#include <optional>
#include <string>

#include "core/foreign/coordinate_force.h"

namespace sinew::osim {

/// The moment as an expression of q for OpenSim's ExpressionBasedCoordinateForce, exact in all digits:
/// "50*exp(min(10,21.88*(-0.2-q)))*(1+max(0,21.88*(-0.2-q)-10))-50*exp(min(10,5.05*(q-2)))*(1+max(0,5.05*(q-2)-10))".
/// An end without structures is left out. @pre at least one end has some.
std::string expressionOf(const PassiveMoment& moment);

/// The moment of such an expression, blanks ignored; nullopt for any other.
std::optional<PassiveMoment> passiveMomentOf(std::string expression);

}  // namespace sinew::osim
