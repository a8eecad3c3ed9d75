#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/support/session.h"
#include "app/experiments/characters.h"
#include "core/strict_json.h"

namespace sinew {

class RetargetReference;

/// A figure that an experiment is held to, beside the paper's.
struct Verdict {
  std::string what, paper, target, ours;
  std::optional<bool> met;  ///< nullopt: reported, not judged
};

struct ExperimentFigure {
  std::string name;  ///< of the files, without extension
  std::string svg;
};

/// What came of one experiment.
struct ExperimentReport {
  Outcome outcome = Outcome::NotRun;
  std::vector<Verdict> verdicts;
  std::string text;  ///< tables for people
  Json result;
  std::vector<ExperimentFigure> figures;
  std::vector<std::filesystem::path> models;  ///< files that it wrote besides
};

/// What experiments share: the reference and the four characters are made once, when they are first asked for.
class ExperimentContext {
 public:
  /// `reference`: "reference", "reference:athlete".
  ExperimentContext(Session& session, std::string reference, std::filesystem::path folder, bool quick)
      : session_{session}, reference_name_{std::move(reference)}, folder_{std::move(folder)}, quick_{quick} {}

  Session& session() const { return session_; }
  const std::filesystem::path& folder() const { return folder_; }  ///< for files
  bool quick() const { return quick_; }                            ///< a small variant, to see that it runs
  Job job() const { return session_.job(); }
  const RetargetReference& reference();
  /// human, alien, hulk, dwarf; null if cancelled.
  const std::vector<Character>* characters();

 private:
  Session& session_;
  std::string reference_name_;
  std::filesystem::path folder_;
  bool quick_;
  std::shared_ptr<const RetargetReference> reference_;
  std::vector<Character> characters_;
};

struct Experiment {
  std::string name;   ///< "rom-preservation"
  std::string title;  ///< one line
  std::function<ExperimentReport(ExperimentContext&)> run;
};

/// In the order of the paper. One function a file of this folder.
const std::vector<Experiment>& experiments();
ExperimentReport romPreservationReport(ExperimentContext& context);
ExperimentReport romEditReport(ExperimentContext& context);
ExperimentReport disordersReport(ExperimentContext& context);
ExperimentReport charactersReport(ExperimentContext& context);
ExperimentReport peakTorqueReport(ExperimentContext& context);
ExperimentReport poseDependenceReport(ExperimentContext& context);
ExperimentReport poplitealReport(ExperimentContext& context);
ExperimentReport examReport(ExperimentContext& context);
ExperimentReport momentArmsReport(ExperimentContext& context);
ExperimentReport energyReport(ExperimentContext& context);

std::string percentText(double share, int decimals = 1);  ///< "12.3 %"

}  // namespace sinew
