#pragma once

namespace sinew {

// One joint turns, all else is held: in its frame J every path point is p = f + R m + Q n, R the joint's rotation, Q
// that of the radius (wrist only). Segments of a path between points that move alike have a constant length; the
// others form runs. Single precision; lengths close to the limit are decided again in double by the caller.

struct GridPoint {
  enum Kind { Fixed, Moving, Mixed, WithRadius };
  int kind;
  float f[3], m[3], n[3];
};

struct GridMuscle {
  int first_run, end_run;
  float constant_m;  ///< length of all that does not change, minus the longest length
  int failures;      ///< cells that this muscle was the first to forbid: the caller asks such muscles first
};

struct GridView {
  static constexpr int kBlock = 16;
  static constexpr float kClose_m = 5e-6f;  ///< several times the rounding of a length in single precision

  int direction_count;    ///< a multiple of kBlock
  const float* R;         ///< 9 rotation entries a direction, in blocks: [block][entry][16]
  const float* Q;         ///< the same of the radius, or null
  const int* run_points;  ///< runs + 1
  const GridPoint* points;
  GridMuscle* muscles;  ///< the first that forbids all lanes ends the search
  int muscle_count;
};

enum class CellState : unsigned char { Forbidden, Allowed, Close };

}  // namespace sinew
