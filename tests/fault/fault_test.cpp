// SPDX-License-Identifier: Apache-2.0
// A run of segment with several outputs, in which one system call fails, or which is killed there.
// After it each file is the old one or the new one, all files alike unless it was killed, and the
// next run leaves nothing behind.
#include <gmock/gmock.h>
#include <signal.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mesamis/files/sha256.h"
#include "support/run_program.h"

namespace mesamis {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using Files = std::map<std::string, std::string>;  // names and bytes

constexpr const char* kReport = "a.json";

/// One folder for all tests: the scan, and what two runs make of it without a fault.
class Fault : public testing::Test {
 protected:
  /// Once; a folder has the name of a test.
  static void prepare() {
    folder_ = std::make_unique<TempFolder>();
    fs::create_directory(out());
    const std::string scan = *folder_ / "scan.nrrd";
    ASSERT_EQ(run_program(*folder_, {"phantom", "sphere", "--size", "10,10,10", "-o", scan}).status,
              0);
    ASSERT_EQ(segment("", "150").status, 4) << "one adaptation shows nothing";
    old_ = files();
    ASSERT_EQ(segment("", "180").status, 4);
    new_ = files();
    ASSERT_EQ(old_.size(), new_.size());
    for (const auto& [name, bytes] : old_) ASSERT_TRUE(bytes != new_.at(name)) << name;
  }
  static void TearDownTestSuite() { folder_.reset(); }
  void SetUp() override {
    if (!folder_) prepare();
    restore(old_);
  }

  static fs::path out() { return *folder_ / "out"; }
  static Files files() {
    Files all;
    for (const auto& entry : fs::directory_iterator(out())) {
      all[entry.path().filename().string()] = read_bytes(entry.path());
    }
    return all;
  }
  static void restore(const Files& all) {
    fs::remove_all(out());
    fs::create_directory(out());
    for (const auto& [name, bytes] : all) write_bytes(out() / name, bytes);
  }

  /// The run, with a fault or without.
  static ProgramRun segment(const std::string& fault, const std::string& level) {
    std::vector<std::string> words;
    if (!fault.empty()) {
      words = {"env", "LD_PRELOAD=" MESAMIS_FAULT_LIBRARY, "MESAMIS_FAULT=" + fault,
               "MESAMIS_FAULT_COUNTS=" + (*folder_ / "counts").string()};
    }
    const auto add = [&words](std::initializer_list<std::string> more) {
      words.insert(words.end(), more);
    };
    add({MESAMIS_PROGRAM, "segment", *folder_ / "scan.nrrd", "--level", level, "--quiet"});
    add({"--threads", fault.starts_with("thread") ? "2" : "1"});
    add({"--adaptations", "1", "--max-tets", level == "150" ? "300" : "400"});
    for (const char* name : {"a.stl", "a.vtp", "a.ply"}) add({"-o", out() / name});
    for (const char* name : {"a.vtu", "a.mesh"}) add({"--mesh", out() / name});
    add({"--labelmap", out() / "a.nii.gz", "--report", out() / kReport});
    return run_command(*folder_, words);
  }

  /// How often the run without a fault makes each of the calls.
  static long calls(const std::string& kind) {
    static std::map<std::string, long> counts;
    if (counts.empty()) {
      segment("none:0", "180");
      std::istringstream lines(read_bytes(*folder_ / "counts"));
      long count = 0;
      for (std::string name; lines >> name >> count;) counts[name] = count;
      restore(old_);
    }
    return counts[kind];
  }

  /// Bytes of a file of the new set; the report's costs differ from run to run.
  static bool is_new(const std::string& name, const std::string& bytes) {
    if (name != kReport) return bytes == new_.at(name);
    return nlohmann::json::parse(bytes)["files"] == nlohmann::json::parse(new_.at(name))["files"];
  }

  struct Found {
    int old_files = 0, new_files = 0, others = 0;
    bool new_report = false;
  };
  static Found look() {
    Found found;
    for (const auto& [name, bytes] : files()) {
      if (!old_.count(name)) {
        ++found.others;
      } else if (bytes == old_[name]) {
        ++found.old_files;
      } else if (is_new(name, bytes)) {
        ++found.new_files;
        found.new_report |= name == kReport;
      }
    }
    return found;
  }

  static int all() { return static_cast<int>(old_.size()); }

  /// Numbers of calls, the first and the last among them, evenly between.
  static std::vector<long> some_of(long count, int most) {
    std::vector<long> numbers;
    for (int i = 0; i < most; ++i) {
      const long number = most == 1 ? 1 : 1 + i * (count - 1) / (most - 1);
      if (number <= count && (numbers.empty() || numbers.back() < number)) {
        numbers.push_back(number);
      }
    }
    return numbers;
  }

  /// One call fails: one line, status 3, everything as it was.
  static void expect_refused(const std::string& kind, long n) {
    const ProgramRun run = segment(kind + ":" + std::to_string(n), "180");
    const Found found = look();
    EXPECT_EQ(run.status, 3) << kind << n << run.err;
    EXPECT_EQ(run.error_lines(), 1u) << kind << n << run.err;
    EXPECT_EQ(found.old_files, all()) << kind << n << run.err;
    EXPECT_EQ(found.others, 0) << kind << n;
    restore(old_);
  }

  static std::unique_ptr<TempFolder> folder_;
  static Files old_, new_;
};

std::unique_ptr<TempFolder> Fault::folder_;
Files Fault::old_, Fault::new_;

TEST_F(Fault, NoneChangesNothing) {
  EXPECT_EQ(segment("none:0", "180").status, 4);
  EXPECT_EQ(look().new_files, all());
  for (const char* kind : {"write", "seek", "rename", "fsync", "alloc", "kill"}) {
    EXPECT_GT(calls(kind), 0) << kind;
  }
}

TEST_F(Fault, AWriteThatFails) {
  for (const long n : some_of(calls("write"), 6)) expect_refused("write", n);
}

TEST_F(Fault, ADiskThatIsFull) {
  for (const long n : some_of(calls("write"), 4)) expect_refused("full", n);
}

TEST_F(Fault, ASeekThatFails) {
  constexpr long kStep = 21;  // a .vtu takes five for an array: each of them is met
  for (long n = 1; n <= calls("seek"); n += kStep) {
    const ProgramRun run = segment("seek:" + std::to_string(n), "180");
    const Found found = look();  // a stream may try twice
    EXPECT_EQ(found.others, 0);
    EXPECT_EQ(run.status == 4 ? found.new_files : found.old_files, all()) << n << run.err;
    EXPECT_THAT(run.status, AnyOf(3, 4)) << n << run.err;
    restore(old_);
  }
}

TEST_F(Fault, ARenameThatFails) {
  for (const long n : some_of(calls("rename"), 4)) {
    // Where two files cannot be exchanged, one is renamed.
    const ProgramRun run = segment("rename:" + std::to_string(n), "180");
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_EQ(look().new_files, all());
    EXPECT_EQ(look().others, 0);
    restore(old_);
  }
  restore({});  // new files are renamed, and that is all
  for (const long n : some_of(all(), 4)) {
    const ProgramRun run = segment("rename:" + std::to_string(n), "180");
    EXPECT_EQ(run.status, 3) << run.err;
    EXPECT_TRUE(files().empty()) << n << ": those before it are taken back";
  }
}

TEST_F(Fault, AFileThatDoesNotReachTheDisk) {
  for (const long n : some_of(all(), 5)) expect_refused("fsync", n);
}

TEST_F(Fault, AFolderThatDoesNotReachTheDisk) {
  const ProgramRun run = segment("fsync:" + std::to_string(calls("fsync")), "180");
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(look().new_files, all()) << "the files have, as all renames came before";
}

TEST_F(Fault, AThreadThatDoesNotStart) {
  for (const long n : {1, 2}) {  // two threads start one
    const ProgramRun run = segment("thread:" + std::to_string(n), "180");
    const Found found = look();
    EXPECT_THAT(run.status, AnyOf(3, 4)) << n << run.err;
    EXPECT_EQ(run.status == 4 ? found.new_files : found.old_files, all()) << n << run.err;
    EXPECT_EQ(found.others, 0) << n;
    restore(old_);
  }
}

TEST_F(Fault, MemoryThatIsNotThere) {
  for (const long n : some_of(calls("alloc"), 8)) {
    const ProgramRun run = segment("alloc:" + std::to_string(n), "180");
    const Found found = look();
    EXPECT_THAT(run.status, AnyOf(3, 4)) << n << run.err;
    EXPECT_THAT(run.err, testing::HasSubstr(run.status == 4 ? "not converged" : "memory")) << n;
    // What fails when all is done, as the end of an object may, leaves everything new.
    EXPECT_TRUE(found.new_files == all() || (run.status == 3 && found.old_files == all())) << n;
    EXPECT_EQ(found.others, 0) << n;
    restore(old_);
  }
}

TEST_F(Fault, KilledAnywhere) {
  // The files are renamed by some of the last calls: between any two of them, too.
  const long most = calls("kill");
  std::vector<long> places = some_of(most, 8);
  for (long n = most - 20; n < most; n += 2) places.push_back(n);
  for (const long n : places) {
    const ProgramRun run = segment("kill:" + std::to_string(n), "180");
    EXPECT_EQ(run.status, -SIGKILL) << n;
    const Found found = look();
    EXPECT_EQ(found.old_files + found.new_files, all()) << n << ": a file is neither old nor new";
    EXPECT_TRUE(!found.new_report || found.new_files == all()) << n << ": the report comes last";
    EXPECT_EQ(segment("", "180").status, 4);
    EXPECT_EQ(look().new_files, all()) << n;
    EXPECT_EQ(look().others, 0) << n << ": something is left after the next run";
    restore(old_);
  }
}

}  // namespace
}  // namespace mesamis
