#include "clinical/pipeline/patient_model.h"

#include "clinical/case/case_io.h"
#include "clinical/case/patient_body.h"
#include "core/file.h"
#include "core/model/physical_scaling.h"

namespace sinew {

FileReference storeModel(const Model& model, const std::filesystem::path& case_dir) {
  const auto file = resultFile(kModelPath, case_dir);
  saveModel(model, file);
  return {kModelPath, sha256OfFile(file)};
}

Model modelBeforeExam(const Case& c, const Model& reference, const std::filesystem::path& case_dir,
                      const std::filesystem::path& resource_dir) {
  if (c.musculature && stateOf(c, Stage::Musculature, resource_dir) == StageState::Done)
    return loadModel(checkedFile(*c.musculature, case_dir), reference);
  Model model = withPhysics(deformedModel(reference, c.skeleton->shape), reference,
                            patientPhysics(c.patient, c.exam, c.skeleton->shape, reference.skeleton));
  model.name = kPatientModelName;
  return model;
}

std::optional<Model> patientModel(const Case& c, const Model& reference, const std::filesystem::path& case_dir,
                                  const std::filesystem::path& resource_dir) {
  if (!c.skeleton || c.skeleton->outcome != Outcome::Converged) return std::nullopt;
  Model model = modelBeforeExam(c, reference, case_dir, resource_dir);
  if (c.exam_fit && stateOf(c, Stage::Exam, resource_dir) == StageState::Done)
    model = withLengthFactors(model, c.exam_fit->length_factors);
  return model;
}

}  // namespace sinew
