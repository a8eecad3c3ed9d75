#include "clinical/pipeline/case_store.h"

#include "clinical/case/case_io.h"
#include "clinical/pipeline/run_case.h"
#include "core/file.h"

namespace sinew {

CaseStore::CaseStore(std::filesystem::path case_dir, std::filesystem::path resource_dir)
    : case_dir_{std::move(case_dir)}, resource_dir_{std::move(resource_dir)} {}

Case CaseStore::load() {
  Case c = loadCase(case_dir_);
  known_ = readFile(caseFile(case_dir_));
  return c;
}

void CaseStore::store(Case& c, Stage stage) {
  const auto file = caseFile(case_dir_);
  const std::string stored = readFile(file);
  if (stored != known_) {
    Case theirs = caseFromJson(stored, file.string());
    known_ = stored;
    if (mergeResults(theirs, c, {&stage, 1}, resource_dir_).empty())
      throw InputError{{file.string(), nameOf(stage), "the inputs that the stage was computed from",
                        "others: the case was changed meanwhile, and the result was not stored; run it again"}};
    c = std::move(theirs);
  }
  saveCase(c, case_dir_);
  known_ = caseToJson(c);
}

}  // namespace sinew
