#include "app/cli/support/session.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "app/cli/support/resource_folder.h"

namespace sinew {
namespace {

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text;
}

/// @throws InputError if it does not arrive: a command whose answer is lost has not done what it was asked.
void print(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    const int reason = errno;
    std::clearerr(stdout);
    throw InputError{{"standard output", "", "a place that takes the answer", std::strerror(reason)}};
  }
}

}  // namespace

void Session::start() {
  auto log = std::make_shared<spdlog::logger>("sinew", std::make_shared<spdlog::sinks::stderr_sink_mt>());
  log->set_pattern("[%H:%M:%S.%e] %v");
  log->set_level(options.verbose ? spdlog::level::debug : spdlog::level::off);
  spdlog::set_default_logger(log);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  progress_ = std::make_unique<Progress>(stderr, options.quiet ? Progress::Style::Quiet
                                                 : terminal    ? Progress::Style::Bar
                                                               : Progress::Style::Lines);
}

const std::filesystem::path& Session::resourceDir() {
  if (!resource_dir_) {
    resource_dir_ = findResourceFolder(executable_, options.resources);
    spdlog::debug("resources: {}", resource_dir_->string());
  }
  return *resource_dir_;
}

Job Session::job() {
  return {.report_to = [this](double fraction, std::string_view work) { progress_->report(fraction, work); },
          .stop = interrupt_.token()};
}

void Session::note(const std::string& line) {
  progress_->line(oneLine(line));
}

void Session::warn(const Warnings& warnings) {
  for (const auto& w : warnings) note("warning: " + w.message + " [" + w.code + "]");
}

void Session::result(const Json& json, const std::string& text) {
  progress_->clear();
  print(options.json ? jsonText(json) : text);
}

void Session::resultLine(const std::string& line) {
  progress_->clear();
  if (!options.json) print(line + "\n");
}

void Session::failure(const InputError::Detail& detail, const std::string& message, const Json& more) {
  progress_->clear();
  Json json = errorJson(detail, oneLine(message));
  if (more.is_object()) json.update(more);
  try {
    if (options.json) print(jsonText(json));
  } catch (const InputError& lost) {
    std::fprintf(stderr, "sinew: %s\n", lost.what());
  }
  if (!options.json)
    std::fprintf(stderr, "%s%s\n", message.starts_with("sinew") ? "" : "sinew: ", oneLine(message).c_str());
}

Json errorJson(const InputError::Detail& detail, const std::string& message) {
  // A message without parts still begins with the place.
  const std::string where = detail.where.empty() ? message.substr(0, message.find(": ")) : detail.where;
  return {{"error",
           {{"where", where},
            {"field", detail.field},
            {"expected", detail.expected},
            {"found", detail.found},
            {"message", message}}}};
}

}  // namespace sinew
