#pragma once
#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/model/explorer/latest_job.h"
#include "app/model/retarget/body_solver.h"
#include "app/model/retarget/rom_handles.h"
#include "core/rom/maps/rom_map.h"

namespace sinew {

/// One joint's range before an edit, as it is wanted, and as muscles and stops solved for it leave it.
struct RomEditPicture {
  std::string joint;
  bool is_ball = true;
  // Of a ball joint, in the zero posture.
  std::optional<RomMap> before, wanted, reached;  ///< reached: once the body is solved
  BallRange ball_before;                          ///< what handles start from
  RomDifference error;                            ///< wanted against reached
  double widest_rad = 0;                          ///< twist range over all three maps
  // Of a hinge: its stops.
  HingeRange hinge_before, hinge_wanted, hinge_reached;
};

/// Makes these pictures beside the window, for the newest of bodies, joints and edits.
class RomEditStudy : public QObject {
  Q_OBJECT
 public:
  explicit RomEditStudy(QObject* parent = nullptr);

  /// `body`: its base is what is edited; `edits` may be newer than those it was solved for (a drag).
  void ask(std::shared_ptr<const RetargetReference> reference, std::shared_ptr<const SolvedBody> body,
           const std::string& joint, const RomEdits& edits);
  const std::optional<RomEditPicture>& picture() const { return picture_; }
  bool isBusy() const { return job_.isBusy(); }

 signals:
  void answered();
  void failed(const QString& message);

 private:
  struct Memory;
  std::shared_ptr<Memory> memory_;  ///< of the thread of the job
  std::optional<RomEditPicture> picture_;
  LatestJob job_;
};

/// Joints whose range can be edited, in the skeleton's order: hinges and ball joints.
std::vector<std::string> editableJoints(const Skeleton& skeleton);

}  // namespace sinew
