#pragma once
#include <QObject>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/model/explorer/latest_job.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

/// The map of one ball joint with another coordinate at two values: what a second joint takes from its range.
struct RomQuestion {
  std::string joint;                      ///< "hip_r"
  std::string with;                       ///< coordinate of another joint, "knee_flexion_r"; empty: one map alone
  std::array<double, 2> with_deg{0, 90};  ///< its two values
  friend bool operator==(const RomQuestion&, const RomQuestion&) = default;
};

struct RomAnswer {
  RomQuestion question;
  std::shared_ptr<const Model> model;
  Posture held;              ///< all other coordinates
  std::vector<RomMap> maps;  ///< one, or two in the order of with_deg
  RomDifference difference;  ///< of the two
  /// Widest twist range over all maps [rad]: the common end of their colours.
  double widest_rad() const;
};

/// Coordinates that may be held at two values beside a joint: angles of other joints.
std::vector<std::string> secondCoordinates(const Skeleton& skeleton, const std::string& joint);
/// The question to begin with: the neighbour that hangs on the joint (hip: knee flexion), else the one it hangs on
/// (ankle: knee flexion), at 0 and at 90 degrees or as far as its envelope goes.
RomQuestion firstQuestion(const Skeleton& skeleton, const std::string& joint);
std::vector<std::string> ballJoints(const Skeleton& skeleton);

/// Computes the maps beside the window; the last answer stays until the next one is complete.
class RomStudy : public QObject {
  Q_OBJECT
 public:
  /// What computes one map; tests put something quick in its place.
  using Mapper = std::function<RomMap(const Model&, const std::string& joint, const Posture& held)>;

  explicit RomStudy(Mapper mapper = {}, QObject* parent = nullptr);

  /// `abandon_running`: the running computation answers another question and is stopped; else it may still answer.
  void ask(std::shared_ptr<const Model> model, const RomQuestion& question, const Posture& held,
           bool abandon_running);
  void cancel() { job_.cancel(); }
  void clear();
  bool isBusy() const { return job_.isBusy(); }
  const JobRunner& runner() const { return job_.runner(); }
  const std::optional<RomAnswer>& answer() const { return answer_; }

 signals:
  void answered();
  void idle();

 private:
  Mapper mapper_;
  std::optional<RomAnswer> answer_;
  LatestJob job_;
};

}  // namespace sinew
