#pragma once
#include <filesystem>
#include <string>

#include "clinical/case/case.h"

namespace sinew {

/// The stored case during a long run: results join what others entered meanwhile instead of overwriting it.
class CaseStore {
 public:
  CaseStore(std::filesystem::path case_dir, std::filesystem::path resource_dir);

  /// @throws InputError as loadCase().
  Case load();

  /// Stores the result of `stage`, which has just ended in `c`. If the file was changed since load() or the last
  /// store(), the result is put into the changed case, and `c` becomes that.
  /// @throws InputError, and leaves the file alone, if what the stage read is another today, or the file is gone.
  void store(Case& c, Stage stage);

 private:
  std::filesystem::path case_dir_, resource_dir_;
  std::string known_;  ///< text of case.json as last seen
};

}  // namespace sinew
