#pragma once
#include <QObject>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/model/explorer/latest_job.h"
#include "core/model/model.h"
#include "core/posture/evaluate.h"
#include "core/rom/maps/coordinate_range.h"
#include "core/skeleton/joint_motion.h"
#include "core/skeleton/posture_file.h"

namespace sinew {

/// What the colour of a muscle says.
enum class MuscleColouring { Group, Activation, FiberLength, PassiveForce };

/// One number a unit for the colours, and what their ends mean.
struct ColourScale {
  QString title;  ///< with unit: "Fibre length / optimal"
  double low = 0, high = 1;
  int decimals = 0;
  bool diverging = false;       ///< the middle is the neutral value
  bool open_ended = false;      ///< values beyond the ends are shown in the end's colour
  std::vector<double> by_unit;  ///< in the unit of the title
};

/// A model that is looked at, outside of any case: which one, in which posture, which muscle is chosen, how active
/// the muscles are. Nothing of it is stored.
class Explorer : public QObject {
  Q_OBJECT
 public:
  explicit Explorer(std::filesystem::path resource_dir, QObject* parent = nullptr);

  /// Shows `model` in the posture that was there, if its skeleton has the same coordinates, else standing.
  /// @throws InputError if the joint motions or preset postures cannot be read.
  void setModel(std::shared_ptr<const Model> model, const QString& title);
  const std::shared_ptr<const Model>& model() const { return model_; }  ///< nullptr at first
  const QString& title() const { return title_; }
  const std::vector<JointMotion>& motions() const { return motions_; }
  /// Standing, zero gravity, T-pose, then those of the resource file.
  const std::vector<NamedPosture>& presets() const { return presets_; }

  /// Clinical coordinates of the posture [rad, m].
  const Eigen::VectorXd& clinical() const { return clinical_; }
  const Posture& posture() const { return posture_; }
  /// The other side follows if the sides are linked.
  void setCoordinate(int coordinate, double value);
  void setPosture(const Posture& posture);
  void mirror();
  void setSidesLinked(bool linked) { linked_ = linked; }

  /// Everything at the present posture, kept until it changes.
  const PostureEvaluation& evaluation() const;
  /// How far an examiner gets with every coordinate, all others held (muscleInducedRange()); computed beside the
  /// window, nullopt until known for some posture. They may belong to the posture before for the moment it takes.
  std::optional<CoordinateRange> range(int coordinate) const;
  bool rangesAreCurrent() const { return ranges_current_; }

  const std::string& muscle() const { return muscle_; }  ///< empty: none
  int muscleIndex() const;                               ///< -1: none
  void setMuscle(const std::string& name);

  /// Units (indices) that one unit stands for: its group on its side.
  std::vector<int> groupOf(int unit) const;
  std::vector<int> agonistsOf(const JointMotion& motion) const;  ///< at the present posture
  const std::vector<double>& activation() const { return activation_; }
  void setActivation(std::span<const int> units, double activation);
  void relaxAll();
  /// Torque of all active units about a coordinate at their activation, passive share included [N m].
  double torque_Nm(int coordinate) const;

  MuscleColouring colouring() const { return colouring_; }
  void setColouring(MuscleColouring colouring);
  /// nullopt while colours stand for groups.
  std::optional<ColourScale> colourScale() const;

 signals:
  void modelChanged();
  void postureChanged();
  void rangesChanged();
  void muscleChanged();
  void coloursChanged();  ///< colouring or activation; a new posture changes the values too

 private:
  void takeClinical(const Eigen::VectorXd& clinical);
  void computeRanges();

  std::filesystem::path resource_dir_;
  std::shared_ptr<const Model> model_;
  QString title_;
  std::vector<JointMotion> motions_;
  std::vector<NamedPosture> presets_;
  Eigen::VectorXd clinical_;
  Posture posture_;
  bool linked_ = false;
  mutable std::optional<PostureEvaluation> evaluation_;
  std::vector<double> examiner_Nm_;  ///< by coordinate: of the examiner of a body of this mass
  std::vector<CoordinateRange> ranges_;
  bool ranges_current_ = false;
  std::string muscle_;
  std::vector<double> activation_;
  MuscleColouring colouring_ = MuscleColouring::Group;
  LatestJob ranges_job_;  ///< last: its thread ends before what it uses goes
};

}  // namespace sinew
