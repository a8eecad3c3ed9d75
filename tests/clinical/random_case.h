#pragma once
#include <random>

#include "clinical/case/case.h"

namespace sinew::test {

/// Cases with every part filled or left out at random: names with quotes and other scripts, NaN where results have
/// none, both kinds of view. Deterministic in the seed.
class RandomCase {
 public:
  explicit RandomCase(unsigned seed) : random_{seed} {}
  Case make();

 private:
  bool coin() { return std::bernoulli_distribution{0.5}(random_); }
  int below(int count) { return std::uniform_int_distribution{0, count - 1}(random_); }
  double number(double lower = -1e3, double upper = 1e3);
  double numberOrNaN();
  std::string text();
  char side() { return coin() ? 'r' : 'l'; }
  Eigen::Vector2d vector2() { return {number(), number()}; }
  Eigen::Vector3d vector3() { return {number(), number(), number()}; }
  Warnings warnings();
  FileReference file(const std::string& path);
  BiplanarRig rig();
  PhysicalExam exam();
  std::map<std::string, double> factors();
  std::vector<BoneFigure> figures();
  Triangulation triangulation();
  SkeletonFit skeletonFit();
  ExamFit examFit();

  std::mt19937 random_;
};

}  // namespace sinew::test
