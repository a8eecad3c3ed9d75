#include "app/model/retarget/characters.h"

#include <chrono>
#include <utility>

#include "core/model/physical_scaling.h"
#include "core/retarget/prepared/reference.h"
#include "core/retarget/retarget.h"

namespace sinew {

CharacterStudy::CharacterStudy(QObject* parent) : QObject{parent} {
  connect(&job_.runner(), &JobRunner::ended, this, [this](JobRunner::Ending ending, const QString& message) {
    if (ending != JobRunner::Ending::Done) emit failed(message);
  });
}

const std::vector<std::string>& characterNames() {
  static const std::vector<std::string> names = {"human", "hulk", "dwarf", "alien"};
  return names;
}

void CharacterStudy::ask(std::shared_ptr<const RetargetReference> reference,
                         const std::filesystem::path& resource_dir) {
  if (!characters_.empty() || job_.isBusy()) return;
  job_.post(tr("Retargeting the characters"), [this, reference, resource_dir](const Job& job) -> JobRunner::Finish {
    std::vector<Character> all;
    const double count = double(characterNames().size());
    for (const auto& name : characterNames()) {
      const double done = double(all.size());
      const Job part{[&](double fraction, std::string_view) { job.report((done + fraction) / count, name); },
                     job.stop};
      const auto start = std::chrono::steady_clock::now();
      const BodyDescription body = loadShapePreset(resource_dir, name);
      Retargeted made = retarget(*reference, body.shape, {}, part);
      if (made.outcome != Outcome::Converged) return {};
      const double solve_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      all.push_back(
          {name, std::make_shared<const Model>(withPhysics(made.model, reference->model(), body.physics)), solve_s});
    }
    return [this, all] {
      characters_ = all;
      emit ready();
    };
  });
}

}  // namespace sinew
