#include "app/model/retarget/design_files.h"

#include "core/file.h"
#include "core/io/mjcf.h"
#include "core/rom/rom_edit_json.h"

namespace sinew {

RomEdits loadRanges(const std::filesystem::path& file, const Skeleton& skeleton) {
  return loadRomEdits(file, skeleton);
}

void saveRanges(const RomEdits& edits, const std::filesystem::path& file) {
  saveRomEdits(edits, file);
}

void exportModel(const Model& model, const std::filesystem::path& file) {
  if (file.extension() == ".xml") return writeFileAtomically(file, mjcfText(model));
  throw InputError{{file.string(), "ending", ".xml (MuJoCo)", "'" + file.extension().string() + "'"}};
}

QString exportFilter() {
  return QStringLiteral("MuJoCo (*.xml)");
}

}  // namespace sinew
