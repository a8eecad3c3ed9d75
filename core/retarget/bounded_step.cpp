#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "core/retarget/bounded_step_internal.h"

namespace sinew {

Eigen::VectorXd boundedStep(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient, const Eigen::MatrixXd& hessian,
                            double low, double high) {
  std::vector<int> free;
  for (int i = 0; i < x.size(); ++i)
    if (!((x[i] <= low && gradient[i] > 0) || (x[i] >= high && gradient[i] < 0))) free.push_back(i);
  Eigen::VectorXd target = x;
  while (!free.empty()) {
    const Eigen::MatrixXd H = hessian(free, free);
    // What is already held at a bound moved by a known amount.
    Eigen::VectorXd g = gradient(free) + hessian(free, Eigen::all) * (target - x);
    g -= H * (target - x)(free);
    const Eigen::VectorXd step = -H.llt().solve(g);
    std::vector<int> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const int i = free[k];
      target[i] = x[i] + step[static_cast<Eigen::Index>(k)];
      if (target[i] >= low && target[i] <= high)
        inside.push_back(i);
      else
        target[i] = std::clamp(target[i], low, high);
    }
    if (inside.size() == free.size()) break;
    free = inside;
    for (const int i : free) target[i] = x[i];
  }
  return target;
}

}  // namespace sinew
