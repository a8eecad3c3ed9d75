#include "clinical/report/judgement.h"

#include <cmath>

namespace sinew {

Judgement judge(double value, double lower95, double upper95, double norm_mean, double norm_sd) {
  constexpr double kBorder_sd = 2;
  const double away = value - norm_mean;
  if (!(norm_sd > 0 && std::abs(away) > kBorder_sd * norm_sd)) return Judgement::Within;
  const double border = norm_mean + std::copysign(kBorder_sd * norm_sd, away);
  const bool certain = away > 0 ? lower95 > border : upper95 < border;
  if (!certain) return Judgement::Within;
  return away > 0 ? Judgement::Above : Judgement::Below;
}

Judgement judgeMeasured(double value, double measurement_sd, double norm_mean, double norm_sd) {
  constexpr double k95 = 1.96;
  return judge(value, value - k95 * measurement_sd, value + k95 * measurement_sd, norm_mean, norm_sd);
}

const char* markOf(Judgement judgement) {
  switch (judgement) {
    case Judgement::Above:
      return " \u25B2";
    case Judgement::Below:
      return " \u25BC";
    case Judgement::Within:
      break;
  }
  return "";
}

}  // namespace sinew
