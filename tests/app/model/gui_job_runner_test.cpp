#include "app/model/job_runner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/error.h"
#include "tests/app/gui_support.h"

namespace sinew {
namespace {

using namespace std::chrono_literals;
using test::letEventsRun;
using test::waitUntil;

class JobRunnerTest : public ::testing::Test {
 protected:
  JobRunnerTest() {
    test::coreApplication();
    QObject::connect(&runner_, &JobRunner::ended, [this](JobRunner::Ending ending, const QString& message) {
      endings_.push_back(ending);
      message_ = message;
    });
    QObject::connect(&runner_, &JobRunner::progressed, [this](double fraction, const QString& stage) {
      fractions_.push_back(fraction);
      stage_ = stage;
    });
  }
  std::vector<JobRunner::Ending> endings_;
  std::vector<double> fractions_;
  QString message_, stage_;
  JobRunner runner_;
};

TEST_F(JobRunnerTest, AppliesTheResultOnTheThreadThatStartedIt) {
  const auto gui_thread = std::this_thread::get_id();
  std::thread::id work_thread, finish_thread;
  ASSERT_TRUE(runner_.start("sum", [&](const Job&) -> JobRunner::Finish {
    work_thread = std::this_thread::get_id();
    return [&] { finish_thread = std::this_thread::get_id(); };
  }));
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_NE(work_thread, gui_thread);
  EXPECT_EQ(finish_thread, gui_thread);
  EXPECT_EQ(endings_, std::vector{JobRunner::Ending::Done});
}

TEST_F(JobRunnerTest, SendsAtMostTwentyReportsASecond) {
  ASSERT_TRUE(runner_.start("count", [](const Job& job) -> JobRunner::Finish {
    const auto end = std::chrono::steady_clock::now() + 500ms;
    for (int i = 0; std::chrono::steady_clock::now() < end; ++i) job.report(i * 1e-9, "counting");
    return {};
  }));
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_GE(fractions_.size(), 2u);
  EXPECT_LE(fractions_.size(), 11u);  // 500 ms / 50 ms, and the first
  EXPECT_EQ(stage_, "counting");
}

TEST_F(JobRunnerTest, OneComputationAtATime) {
  std::atomic<bool> go{false};
  ASSERT_TRUE(runner_.start("first", [&](const Job&) -> JobRunner::Finish {
    while (!go) std::this_thread::sleep_for(1ms);
    return {};
  }));
  bool second_ran = false;
  EXPECT_FALSE(runner_.start("second", [&](const Job&) -> JobRunner::Finish {
    second_ran = true;
    return {};
  }));
  go = true;
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_FALSE(second_ran);
  EXPECT_EQ(endings_.size(), 1u);
}

TEST_F(JobRunnerTest, UnusableInputBecomesOneLineForThePerson) {
  ASSERT_TRUE(runner_.start("read", [](const Job&) -> JobRunner::Finish {
    throw InputError{{"rig.json", "version", "1", "7"}};
  }));
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_EQ(endings_, std::vector{JobRunner::Ending::Failed});
  EXPECT_EQ(message_, "rig.json: version: expected 1, found 7");
}

TEST_F(JobRunnerTest, AFaultOfOursIsCaughtAtTheThreadsTop) {
  ASSERT_TRUE(runner_.start("break", [](const Job&) -> JobRunner::Finish { throw std::logic_error{"no bones"}; }));
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_EQ(endings_, std::vector{JobRunner::Ending::Failed});
  EXPECT_TRUE(message_.contains("no bones"));
}

TEST_F(JobRunnerTest, CancelAnswersWithin200MillisecondsEvenIfTheComputationIsDeaf) {
  std::atomic<bool> release{false};
  bool applied = false, kept = false;
  ASSERT_TRUE(runner_.start(
      "deaf",
      [&](const Job&) -> JobRunner::Finish {
        while (!release) std::this_thread::sleep_for(1ms);
        return [&] { applied = true; };
      },
      [&] { kept = true; }));
  letEventsRun(30);
  QElapsedTimer clock;
  clock.start();
  runner_.cancel();
  ASSERT_TRUE(waitUntil([&] { return !endings_.empty(); }, 1000));
  EXPECT_LE(clock.elapsed(), 200);
  EXPECT_EQ(endings_, std::vector{JobRunner::Ending::Cancelled});
  EXPECT_FALSE(runner_.isRunning());
  EXPECT_TRUE(runner_.isBusy());  // the thread is still there: nothing new may start
  EXPECT_FALSE(runner_.start("next", [](const Job&) -> JobRunner::Finish { return {}; }));

  release = true;
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }));
  EXPECT_FALSE(applied);
  EXPECT_TRUE(kept);
  EXPECT_EQ(endings_.size(), 1u);
  EXPECT_TRUE(runner_.start("next", [](const Job&) -> JobRunner::Finish { return {}; }));
}

TEST_F(JobRunnerTest, AnAttentiveComputationStopsAtOnce) {
  ASSERT_TRUE(runner_.start("attentive", [](const Job& job) -> JobRunner::Finish {
    while (!job.cancelled()) std::this_thread::sleep_for(1ms);
    return {};
  }));
  letEventsRun(20);
  runner_.cancel();
  ASSERT_TRUE(waitUntil([&] { return !runner_.isBusy(); }, 1000));
  EXPECT_EQ(endings_, std::vector{JobRunner::Ending::Cancelled});
}

TEST_F(JobRunnerTest, DestroyingTheRunnerStopsTheComputation) {
  std::atomic<bool> stopped{false};
  {
    JobRunner short_lived;
    short_lived.start("endless", [&](const Job& job) -> JobRunner::Finish {
      while (!job.cancelled()) std::this_thread::sleep_for(1ms);
      stopped = true;
      return {};
    });
  }
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace sinew
