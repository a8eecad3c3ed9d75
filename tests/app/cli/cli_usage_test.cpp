#include <signal.h>

#include "tests/app/cli/cli_support.h"

namespace sinew {
namespace {

using test::documentOf;
using test::ProgramResult;
using test::sinewProgram;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Commands that a help text lists.
std::vector<std::string> listedCommands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream in{help};
  std::string line;
  bool listing = false;
  while (std::getline(in, line)) {
    if (line == "Subcommands:") {
      listing = true;
    } else if (listing && line.starts_with("  ") && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    } else if (listing && line.empty()) {
      break;
    }
  }
  return names;
}

void expectHelp(const std::vector<std::string>& command) {
  std::vector<std::string> arguments = command;
  arguments.push_back("--help");
  const ProgramResult help = sinewProgram(arguments);
  SCOPED_TRACE(::testing::PrintToString(command));
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(help.out, AllOf(HasSubstr("Usage: sinew"), HasSubstr("Example:\n  sinew ")));
  for (const auto& name : listedCommands(help.out)) {
    std::vector<std::string> deeper = command;
    deeper.push_back(name);
    expectHelp(deeper);
  }
}

TEST(CliUsage, EveryCommandExplainsItselfWithAnExample) {
  expectHelp({});
  EXPECT_GE(listedCommands(sinewProgram({"--help"}).out).size(), 2u);
}

TEST(CliUsage, VersionIsOnStdout) {
  EXPECT_THAT(sinewProgram({"--version"}).out, HasSubstr("sinew 0."));
}

TEST(CliUsage, WrongNamesAreAnsweredWithTheNearest) {
  ProgramResult result = sinewProgram({"trianglate", "--rig", "x"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(HasSubstr("'trianglate'"), HasSubstr("nearest: triangulate")));

  result = sinewProgram({"triangulate", "--sighting", "x"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("'--sighting'"), HasSubstr("nearest: --sightings")));

  result = sinewProgram({"rig", "import", "--format", "mayacan", "a", "b"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("nearest: mayacam"));
}

TEST(CliUsage, ErrorsAreOneLineOnStderrOrOneDocumentOnStdout) {
  const ProgramResult text = sinewProgram({"rig", "info", "/nowhere/rig.json"});
  EXPECT_EQ(text.status, 2);
  EXPECT_THAT(text.out, IsEmpty());
  EXPECT_EQ(text.err,
            "sinew: /nowhere/rig.json: expected a file that can be read, found No such file or directory\n");

  const ProgramResult json = sinewProgram({"rig", "info", "/nowhere/rig.json", "--json"});
  EXPECT_EQ(json.status, 2);
  EXPECT_THAT(json.err, IsEmpty());
  const Json error = documentOf(json)["error"];
  EXPECT_EQ(error["where"], "/nowhere/rig.json");
  for (const char* member : {"field", "expected", "found", "message"}) EXPECT_TRUE(error.contains(member)) << member;
}

TEST(CliUsage, AFolderThatCannotBeMadeIsNoFaultOfOurs) {
  const ProgramResult result = sinewProgram({"demo", "--out", "/proc/sinew", "--binning", "4", "--json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(documentOf(result)["error"]["expected"], "a folder that can be written");
}

TEST(CliUsage, UsageErrorsObeyJsonToo) {
  const ProgramResult result = sinewProgram({"--json", "rig", "info"});
  EXPECT_EQ(result.status, 2);
  const Json document = documentOf(result);
  EXPECT_EQ(document["error"]["where"], "sinew rig info");
  EXPECT_THAT(document["error"]["found"].get<std::string>(), HasSubstr("RIG is required"));
}

TEST(CliUsage, TheWindowRefusesAFolderWithoutACaseBeforeItNeedsADisplay) {
  const ProgramResult result = sinewProgram({"window", "/nowhere/case"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("/nowhere/case"), HasSubstr("case.json")));
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 1);
}

}  // namespace
}  // namespace sinew
