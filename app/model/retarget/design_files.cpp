#include "app/model/retarget/design_files.h"

#include "core/file.h"
#include "core/foreign/foreign_from_model.h"
#include "core/foreign/length_deviation.h"
#include "core/io/mjcf/mjcf.h"
#include "core/io/osim/osim_reader.h"
#include "core/io/osim/osim_writer.h"
#include "core/rom/edit/rom_edit_json.h"

namespace sinew {

RomEdits loadRanges(const std::filesystem::path& file, const Skeleton& skeleton) {
  return loadRomEdits(file, skeleton);
}

void saveRanges(const RomEdits& edits, const std::filesystem::path& file) {
  saveRomEdits(edits, file);
}

std::string exportModel(const Model& model, const std::filesystem::path& file) {
  if (file.extension() == ".xml") {
    writeFileAtomically(file, mjcfText(model));
    return summaryText(mjcfDeviation(model));
  }
  if (file.extension() == ".osim") {
    const ForeignModel foreign = foreignFromModel(model);
    OsimOptions options;
    options.remarks = {"Exported by Sinew from the model '" + model.name + "'. Coordinates are clinical angles."};
    // What is said is what a reader of the file gets.
    const std::string summary =
        summaryText(lengthDeviation(model, osimFromText(osimText(foreign, options), file.string())));
    options.remarks.push_back(summary + ".");
    writeFileAtomically(file, osimText(foreign, options));
    return summary;
  }
  throw InputError{
      {file.string(), "ending", ".osim (OpenSim) or .xml (MuJoCo)", "'" + file.extension().string() + "'"}};
}

QString exportFilter() {
  return QStringLiteral("OpenSim (*.osim);;MuJoCo (*.xml)");
}

}  // namespace sinew
