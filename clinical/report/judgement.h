#pragma once

namespace sinew {

/// Where a measured value lies against its norm.
enum class Judgement { Within, Above, Below };

/// A value is called abnormal only if it is more than 2 SD from the mean of its norm and its measurement error does
/// not explain that: its 95 % interval excludes the border of 2 SD. Within also if anything is NaN. One rule for
/// bones and examination, in window and report.
Judgement judge(double value, double lower95, double upper95, double norm_mean, double norm_sd);
/// The same of a value whose measurement has a standard deviation.
Judgement judgeMeasured(double value, double measurement_sd, double norm_mean, double norm_sd);

/// " ▲", " ▼" or nothing: behind the value.
const char* markOf(Judgement judgement);

}  // namespace sinew
