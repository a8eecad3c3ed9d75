#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "clinical/case/case.h"
#include "imaging/radiograph/radiograph.h"

namespace sinew {

/// Radiographs of the open case, each read once. Safe from several threads.
class ImageStore {
 public:
  /// @throws InputError if the file is missing, is not what the reference says, or cannot be read as a radiograph.
  std::shared_ptr<const Radiograph> image(const CaseImage& image, const std::filesystem::path& case_dir);
  void clear();

 private:
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const Radiograph>> images_;  ///< by content and declared spacing
};

/// Half the size by averaging 2 x 2 pixels (an odd last row or column is dropped): for fast views of large images.
Radiograph halfSize(const Radiograph& radiograph);

}  // namespace sinew
