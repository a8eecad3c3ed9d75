#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/cli/support/exit_status.h"
#include "app/cli/support/interrupt.h"
#include "app/cli/support/progress.h"
#include "clinical/case/case.h"
#include "core/foreign/foreign_model.h"
#include "core/model/model.h"
#include "core/strict_json.h"

namespace sinew {

class RetargetReference;

/// Draws the report of a case; supplied by the application.
using ReportWriter =
    std::function<void(const Case&, const std::filesystem::path& case_dir, const std::filesystem::path& pdf,
                       const Model& reference, const std::filesystem::path& resource_dir)>;

/// Options that every command has.
struct GlobalOptions {
  bool json = false, quiet = false, verbose = false;
  std::filesystem::path resources;  ///< empty: to be found
};

/// What a command works with: options, output, progress, and the reference model once it is needed.
class Session {
 public:
  /// `executable`: where the program is, to find the resources beside it.
  Session(std::filesystem::path executable, ReportWriter write_report)
      : executable_{std::move(executable)}, write_report_{std::move(write_report)} {}

  GlobalOptions options;

  /// To be called once the options are known.
  void start();

  /// --resources, else SINEW_RESOURCE_DIR, else ../resources or ../share/sinew/resources beside the executable.
  /// @throws InputError naming all places if there is none.
  const std::filesystem::path& resourceDir();
  const Model& reference();
  /// What musculatures are retargeted from, made at the first call (a second).
  std::shared_ptr<const RetargetReference> retargeting();
  /// "reference", "reference:athlete" or a model file.
  Model model(const std::string& name_or_file);
  /// A model of another program, if the name is that of such a file; its warnings are shown. nullopt otherwise.
  std::optional<ForeignModel> foreignModel(const std::string& file);
  const ReportWriter& reportWriter() const { return write_report_; }

  Job job();                            ///< progress to stderr, stopped by Ctrl-C
  void note(const std::string& line);   ///< one line on stderr unless quiet
  void warn(const Warnings& warnings);  ///< "warning: ..." lines on stderr unless quiet

  /// The result of the command on stdout: `text` for people, or `json` as the one document with --json.
  void result(const Json& json, const std::string& text);
  /// A piece of the result for people, as soon as it is there; nothing with --json.
  void resultLine(const std::string& line);
  /// The answer to a failed command: JSON on stdout with --json, else one line on stderr. `more` joins the document.
  void failure(const InputError::Detail& detail, const std::string& message, const Json& more = Json::object());

 private:
  std::filesystem::path executable_;
  ReportWriter write_report_;
  Interrupt interrupt_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>(stderr, Progress::Style::Quiet);
  std::optional<std::filesystem::path> resource_dir_;
  std::shared_ptr<const Model> reference_;
  std::shared_ptr<const RetargetReference> retargeting_;
};

/// {"error": {"where", "field", "expected", "found", "message"}}.
Json errorJson(const InputError::Detail& detail, const std::string& message);

}  // namespace sinew
