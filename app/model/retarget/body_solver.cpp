#include "app/model/retarget/body_solver.h"

#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/model/physical_scaling.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {
namespace {

using Clock = std::chrono::steady_clock;

double since_s(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Job share(const Job& job, double from, double to) {
  return {[report = job.report_to, from, to](double fraction, std::string_view stage) {
            if (report) report(from + (to - from) * fraction, stage);
          },
          job.stop};
}

}  // namespace

/// What the last solution leaves for the next: a change of masses or of a range of motion does not retarget again.
/// Touched by one computation at a time.
struct BodySolver::Memory {
  std::shared_ptr<const RetargetReference> reference;
  std::optional<ShapeParameters> shape;
  std::shared_ptr<const Model> plain_naive, plain_model;  ///< before masses and strengths
  Retargeted retargeted;  ///< the next shape takes over from it what it does not touch
  std::vector<MuscleChange> changes;
  std::optional<PhysicsFactors> physics;
  std::shared_ptr<const Model> naive, base;
  std::unique_ptr<RomEditSolver> editor;

  bool retargetTo(const ShapeParameters& wanted, const Job& job) {
    if (shape == wanted) return true;
    Retargeted next =
        shape ? retarget(*reference, wanted, {}, job, retargeted) : retarget(*reference, wanted, {}, job);
    if (next.outcome != Outcome::Converged) return false;
    shape = wanted;
    physics.reset();
    plain_naive = std::make_shared<const Model>(deformedModel(reference->model(), wanted));
    changes = muscleChanges(*reference, *plain_naive, next);
    plain_model = std::make_shared<const Model>(next.model);
    retargeted = std::move(next);
    return true;
  }
  void applyPhysics(const BodyDescription& body) {
    if (physics == body.physics) return;
    const auto with = [&](const Model& model) {
      Model scaled = withPhysics(model, reference->model(), body.physics);
      scaled.name = body.name;
      return std::make_shared<const Model>(std::move(scaled));
    };
    naive = with(*plain_naive);
    base = with(*plain_model);
    editor.reset();
    physics = body.physics;
  }
  std::optional<RomEditResult> editRanges(const RomEdits& edits, const Job& job) {
    if (isIdentity(edits)) return std::nullopt;
    checkRomEdits(base->skeleton, edits, "range of motion");
    job.report(0.1, "ranges of motion");
    if (!editor) editor = std::make_unique<RomEditSolver>(*base, reference->poses());
    return editor->solve(edits, {}, job);
  }
};

BodySolver::BodySolver(QObject* parent) : QObject{parent} {
  connect(&loading_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) fail(message);
  });
  connect(&drawing_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) fail(message);
  });
  connect(&solving_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending == JobRunner::Ending::Failed) fail(message);
    emit stateChanged();
  });
  connect(&solving_, &LatestJob::idle, this, &BodySolver::stateChanged);
}

void BodySolver::fail(const QString& message) {
  problem_ = message;
  current_ = false;
  emit stateChanged();
}

void BodySolver::load(Loader loader) {
  if (reference_ || loading_.isBusy()) return;
  problem_.clear();
  loading_.post(tr("Preparing the reference"), [this, loader = std::move(loader)](const Job&) -> JobRunner::Finish {
    auto reference = loader();
    auto live = std::make_shared<LiveBody>(std::shared_ptr<const Model>{reference, &reference->model()});
    return [this, reference, live] {
      reference_ = reference;
      live_ = live;
      memory_ = std::make_shared<Memory>();
      memory_->reference = reference;
      emit referenceLoaded();
      emit stateChanged();
    };
  });
}

void BodySolver::postNaive(const RetargetDesign& design) {
  if (naive_ && design.body.shape == naive_shape_) return;
  naive_shape_ = design.body.shape;
  drawing_.post(tr("Bones"), [this, live = live_, shape = design.body.shape](const Job&) -> JobRunner::Finish {
    const auto start = Clock::now();
    auto model = live->deformed(shape);
    return [this, model, time_s = since_s(start)] {
      naive_ = model;
      naive_s_ = time_s;
      emit naiveChanged();
    };
  });
}

void BodySolver::preview(const RetargetDesign& design) {
  if (!reference_) return;
  solving_.cancel();
  current_ = cancelled_ = false;
  problem_.clear();
  postNaive(design);
  emit stateChanged();
}

void BodySolver::solve(const RetargetDesign& design) {
  if (!reference_) return;
  cancelled_ = false;
  problem_.clear();
  if (body_ && body_->design == design) {  // undone while nothing newer was ready
    solving_.cancel();
    postNaive(design);
    current_ = true;
    emit bodyChanged();
    emit stateChanged();
    return;
  }
  current_ = false;
  postNaive(design);
  solving_.post(
      tr("Retargeting the muscles"),
      [this, memory = memory_, design](const Job& job) -> JobRunner::Finish {
        const auto start = Clock::now();
        if (!memory->retargetTo(design.body.shape, share(job, 0, 0.8))) return {};
        memory->applyPhysics(design.body);
        auto body = std::make_shared<SolvedBody>();
        try {
          body->rom = memory->editRanges(design.rom, share(job, 0.8, 1));
        } catch (const InputError& error) {  // the body is there all the same
          body->rom_problem = QString::fromUtf8(error.what());
        }
        if (job.cancelled()) return {};
        body->design = design;
        body->naive = memory->naive;
        body->base = body->model = memory->base;
        body->changes = memory->changes;
        if (body->rom) {
          body->model = std::make_shared<const Model>(std::exchange(body->rom->model, Model{}));
          for (const RomEditChange& change : body->rom->changed)
            body->changes[std::size_t(body->model->musculature.unitIndex(change.unit))].rom_factor =
                change.length_factor;
        }
        body->solve_s = since_s(start);
        return [this, body] {
          body_ = body;
          current_ = true;
          emit bodyChanged();
          emit stateChanged();
        };
      },
      true);
  emit stateChanged();
}

void BodySolver::cancel() {
  if (!solving_.isBusy()) return;
  solving_.cancel();
  cancelled_ = true;
  emit stateChanged();
}

}  // namespace sinew
