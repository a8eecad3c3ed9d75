#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/model/explorer/latest_job.h"
#include "app/model/retarget/live_body.h"
#include "app/model/retarget/muscle_change.h"
#include "app/model/retarget/retarget_design.h"
#include "core/rom/edit/rom_edit_solve.h"

namespace sinew {

class RetargetReference;

/// A designed body after everything is computed. Constant once made.
struct SolvedBody {
  RetargetDesign design;
  std::shared_ptr<const Model> naive;  ///< muscles moved with their bones, with the design's masses and strengths
  std::shared_ptr<const Model> base;   ///< retargeted, ranges of motion not edited yet
  std::shared_ptr<const Model> model;  ///< and with these edits: what is saved
  std::vector<MuscleChange> changes;   ///< by unit
  std::optional<RomEditResult> rom;    ///< its model is left empty; nullopt without edits, or if they fail
  QString rom_problem;                 ///< why the edits fail
  double solve_s = 0;                  ///< all of it, on the clock
};

/// Computes designed bodies beside the window: bones and naive muscles at once, while a slider moves; the retargeted
/// muscles as soon as they are ready. A newer design stops what runs for an older one.
class BodySolver : public QObject {
  Q_OBJECT
 public:
  using Loader = std::function<std::shared_ptr<const RetargetReference>()>;
  explicit BodySolver(QObject* parent = nullptr);

  /// Loads the reference beside the window, if that has not been done yet.
  void load(Loader loader);
  const std::shared_ptr<const RetargetReference>& reference() const { return reference_; }  ///< nullptr at first

  /// Bones and naive muscles alone; stops the solution of an older design.
  void preview(const RetargetDesign& design);
  /// Everything. Nothing happens before the reference is loaded.
  void solve(const RetargetDesign& design);
  void cancel();

  /// Newest bones with naive muscles; nullptr at first.
  const std::shared_ptr<const Model>& naive() const { return naive_; }
  /// Newest solved body; it may be of an older design. nullptr at first.
  const std::shared_ptr<const SolvedBody>& body() const { return body_; }
  /// Whether body() is of the newest design.
  bool isCurrent() const { return body_ && current_; }
  bool isSolving() const { return solving_.isBusy(); }
  double naive_s() const { return naive_s_; }          ///< time of the newest bones
  const QString& problem() const { return problem_; }  ///< why the newest design has no body; empty: no reason
  bool wasCancelled() const { return cancelled_; }

  const JobRunner& runner() const { return solving_.runner(); }  ///< for its progress

 signals:
  void referenceLoaded();
  void naiveChanged();
  void bodyChanged();
  void stateChanged();  ///< started, ended, cancelled, failed: any of the questions above has another answer

 private:
  struct Memory;
  void postNaive(const RetargetDesign& design);
  void fail(const QString& message);

  std::shared_ptr<const RetargetReference> reference_;
  std::shared_ptr<const Model> naive_;
  std::shared_ptr<const SolvedBody> body_;
  std::shared_ptr<Memory> memory_;  ///< of the solving thread
  std::shared_ptr<LiveBody> live_;  ///< of the drawing thread
  ShapeParameters naive_shape_;     ///< asked for last
  bool current_ = false, cancelled_ = false;
  double naive_s_ = 0;
  QString problem_;
  LatestJob loading_, drawing_, solving_;  ///< last: their threads end before what they use goes
};

}  // namespace sinew
