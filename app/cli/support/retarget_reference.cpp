#include "app/cli/support/retarget_reference.h"
#include "core/retarget/prepared/reference.h"

#include <unistd.h>

#include <chrono>
#include <future>

namespace sinew {

std::shared_ptr<const RetargetReference> preparedReference(Session& session, const std::string& model_name,
                                                           const std::string& where, const Json& cancelled) {
  const auto preset = presetOf(model_name);
  if (!preset) throw InputError{{where, "--reference", "reference or reference:athlete", "'" + model_name + "'"}};
  const Job job = session.job();
  auto prepared = std::async(std::launch::async, [folder = session.resourceDir(), preset] {
    return loadRetargetReference(folder, *preset);
  });
  job.report(0, "preparing the reference");
  while (prepared.wait_for(std::chrono::milliseconds{20}) != std::future_status::ready)
    if (job.cancelled()) {
      session.result(cancelled, "cancelled\n");
      _exit(static_cast<int>(ExitStatus::NotConverged));
    }
  return prepared.get();
}

}  // namespace sinew
