// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "session.h"

using namespace sigs;
using namespace sigs::editor;

namespace {

// Temporary folders in memory while this exists, where the machine has such a place: every save waits until its file
// is on the disk, which takes most of the time of 10,000 sequences.
class FoldersInMemory {
 public:
  FoldersInMemory() {
    if (const char* folder = std::getenv("TMPDIR")) before_ = folder;
    if (::access("/dev/shm", W_OK) == 0) ::setenv("TMPDIR", "/dev/shm", 1);
  }
  ~FoldersInMemory() {
    if (before_)
      ::setenv("TMPDIR", before_->c_str(), 1);
    else
      ::unsetenv("TMPDIR");
  }
  FoldersInMemory(const FoldersInMemory&) = delete;
  FoldersInMemory& operator=(const FoldersInMemory&) = delete;

 private:
  std::optional<std::string> before_;
};

// What a project says, as far as this test goes: a number that no other edit gives, which footage it means, and whether
// it was given a name.
struct Content {
  int speed = 0;
  int footage = 0;
  bool is_named = false;

  [[nodiscard]] bool operator==(const Content&) const = default;
};

// An editor with its user, and beside it a plain model: what each file has to hold, and which file the project belongs
// to. Every act does the same to both, and compares them.
class EditorAndModel {
 public:
  explicit EditorAndModel(std::uint64_t seed) : random_(seed) {
    for (const char* name : {"one", "two", "two/deep", "state"}) fs::create_directories(folder_ / name);
    for (const char* name : {"one/a.json", "one/b.json", "two/deep/c.json"}) files_.push_back(folder_ / name);
    write_from_outside(0);
    write_from_outside(2);
    start();
    open(0);
    compare();
  }

  void begin_sequence() { log_.clear(); }

  void act() {
    switch (pick(16)) {
      case 0:
        open(pick(3));
        break;
      case 1:
        reload();
        break;
      case 2:
        (void)save_as_named();
        break;
      case 3:
        save_as_asked();
        break;
      case 4:
        kill();
        break;
      case 5:
        pick(2) == 0 ? write_from_outside(pick(3)) : begin_anew();
        break;
      case 6:
        wait_for_recovery();
        break;
      case 7:
      case 8:
      case 9:
        undo();
        break;
      case 10:
      case 11:
        redo();
        break;
      default:
        edit();
    }
    compare();
  }

  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] int saves() const { return saves_; }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  int number_of(const fs::path& file) const {
    for (std::size_t i = 0; i < files_.size(); ++i)
      if (files_[i] == file) return static_cast<int>(i);
    return -1;
  }

  void note(const std::string& what) { log_ += what + "; "; }
  void expect(bool holds, const std::string& what) {
    if (!holds && failure_.empty()) failure_ = what + " after: " + log_;
  }

  // The program is started, for the first time or after a crash.
  void start() {
    session_.reset();
    document_ = std::make_unique<Document>();
    session_ = std::make_unique<ProjectSession>(*document_, settings_,
                                                ProjectSession::Environment{.recovery_folder = folder_ / "state",
                                                                            .wake = [] {},
                                                                            .is_exporting = {},
                                                                            .mask = {},
                                                                            .is_asking_for_file = {}});
    has_project_ = false;
  }

  void wait() {
    update();
    while (!session_->loading().empty()) {
      std::this_thread::sleep_for(std::chrono::microseconds(20));
      update();
    }
  }

  void update() { session_->update(now_s_); }

  // The user's part ----------------------------------------------------------------------------------------------

  void open(int number) {
    note("open " + std::to_string(number));
    session_->handle(OpenProject{files_[static_cast<std::size_t>(number)]});
    if (!may_leave()) return;
    wait();
    const std::string name = files_[static_cast<std::size_t>(number)].string();
    if (disk_.count(name) == 0) return forget_kept_where_saved();  // an error is shown, and the project stays
    show(files_[static_cast<std::size_t>(number)], disk_[name]);
    saved_ = disk_[name];
  }

  void reload() {
    if (has_project_ && !file_.empty()) open(number_of(file_));
  }

  void begin_anew() {
    note("new");
    session_->handle(NewProject{});
    if (!may_leave()) return;
    show({}, {});
    saved_ = Content();
  }

  void edit() {
    if (!has_project_) return;
    Content changed = states_[present_];
    changed.speed = ++last_speed_;
    if (pick(3) == 0) changed.footage = 1 + pick(3);
    note("edit " + std::to_string(changed.speed));
    document_->apply(ChangeProject{"edit",
                                   [&](Project& p) {
                                     p.camera.speed_mps = changed.speed;
                                     if (changed.footage != 0)
                                       p.footage.video = path_in_project(p, clip(changed.footage));
                                   },
                                   {}});
    states_.resize(present_ + 1);
    states_.push_back(changed);
    ++present_;
  }

  void undo() {
    note("undo");
    if (has_project_) document_->apply(Edit(Undo{}));
    if (has_project_ && present_ > 0) --present_;
  }

  void redo() {
    note("redo");
    if (has_project_) document_->apply(Edit(Redo{}));
    if (has_project_ && present_ + 1 < states_.size()) ++present_;
  }

  void save_as_asked() {
    if (!has_project_) return;
    note("save");
    session_->handle(SaveProject{});
    (void)answer_saving();
  }

  bool save_as_named() {
    if (!has_project_) return false;
    const fs::path chosen = files_[static_cast<std::size_t>(pick(3))];
    note("save as " + std::to_string(number_of(chosen)));
    session_->handle(SaveProjectAs{chosen});
    return written(chosen);
  }

  void kill() {
    note("kill");
    start();
    const std::vector<AbandonedProject> abandoned = session_->abandoned();
    expect(abandoned.size() == (kept_ ? 1U : 0U), "recovery has another number of projects");
    if (!kept_ || abandoned.empty()) return;
    expect(abandoned[0].project_file == kept_->file, "recovery names " + abandoned[0].project_file.string());
    if (pick(2) == 0) {
      note("discard");
      session_->discard(abandoned[0]);
      session_->answer(0);
      kept_.reset();
      return;
    }
    note("recover");
    session_->recover(abandoned[0]);
    const Kept kept = *kept_;
    show(kept.file, kept.content);
    kept_ = kept;
    saved_.reset();
    known_ = kept.known;
  }

  // Long enough for unsaved work to be kept.
  void wait_for_recovery() {
    note("wait");
    update();
    now_s_ += 1000;
    update();
    forget_kept_where_saved();
    if (has_project_ && is_unsaved()) kept_ = Kept{file_, states_[present_], known_};
  }

  // Another program writes a file, which has a time of its own: a file system's clock may be coarse.
  void write_from_outside(int number) {
    note("another program writes " + std::to_string(number));
    const fs::path file = files_[static_cast<std::size_t>(number)];
    Project project;
    project.camera.speed_mps = ++last_speed_;
    project.footage.video = clip(1).string();
    const std::string name = file.string();
    bytes_[name] = text_of(project);
    test::write_file(file, bytes_[name]);
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(last_speed_));
    disk_[name] = {.speed = last_speed_, .footage = 1};
    ++versions_[name];
  }

  // The program's questions --------------------------------------------------------------------------------------

  // Whether what was asked for may go on.
  bool may_leave() {
    if (!has_project_ || !is_unsaved()) {
      expect(!session_->question(), "a question without unsaved work");
      return true;
    }
    expect(session_->question() && session_->question()->title == "Unsaved changes", "unsaved work is not asked for");
    if (!session_->question()) return false;
    const int answer = pick(3);
    note("answer " + std::to_string(answer));
    session_->answer(answer);
    return answer == 1 || (answer == 0 && answer_saving());
  }

  // What follows on Save. Whether it was saved.
  bool answer_saving() {
    if (file_.empty()) return choose_file();
    const bool is_there = disk_.count(file_.string()) != 0;
    if (!is_there || versions_[file_.string()] == known_) return written(file_);
    expect(session_->question() && session_->question()->title == "Changed on disk", "a change on disk is not noticed");
    if (!session_->question()) return false;
    const int answer = pick(3);
    note("answer " + std::to_string(answer));
    session_->answer(answer);
    if (answer == 0) return choose_file();
    return answer == 1 && written(file_);
  }

  bool choose_file() {
    std::function<void(const fs::path&)> chosen;
    for (const Request& request : session_->take_requests())
      if (const auto* wanted = std::get_if<AskForFile>(&request)) chosen = wanted->chosen;
    expect(static_cast<bool>(chosen), "no name is asked for");
    if (!chosen || pick(4) == 0) return false;
    const fs::path file = files_[static_cast<std::size_t>(pick(3))];
    note("as " + std::to_string(number_of(file)));
    chosen(file);
    return written(file);
  }

  // The model's part ---------------------------------------------------------------------------------------------

  // A file that another program wrote, or that was opened, or saved to, is known as it is.
  void know_file() { known_ = versions_[file_.string()]; }
  [[nodiscard]] bool is_unsaved() const { return !saved_ || !(*saved_ == states_[present_]); }

  // A project without a name takes that of its file, which is a step of its own.
  bool written(const fs::path& file) {
    expect(!session_->question(), "a question instead of saving");
    if (file_.empty() && !states_[present_].is_named) {
      states_.resize(present_ + 1);
      states_.push_back(states_[present_]);
      states_[++present_].is_named = true;
    }
    file_ = file;
    disk_[file.string()] = states_[present_];
    bytes_.erase(file.string());
    ++versions_[file.string()];
    know_file();
    saved_ = states_[present_];
    kept_.reset();
    ++saves_;
    return true;
  }

  void show(const fs::path& file, Content content) {
    has_project_ = true;
    file_ = file;
    states_ = {content};
    present_ = 0;
    kept_.reset();
    if (!file.empty()) know_file();
  }

  void forget_kept_where_saved() {
    if (has_project_ && !is_unsaved()) kept_.reset();
  }

  [[nodiscard]] fs::path clip(int number) const { return folder_ / "clips" / (std::to_string(number) + ".mp4"); }

  [[nodiscard]] Content content_of(const Project& project) const {
    Content content{static_cast<int>(project.camera.speed_mps), 0, project.name != Project().name};
    if (project.footage.video.empty()) return content;
    const fs::path meant = fs::absolute(resolved(project, project.footage.video)).lexically_normal();
    for (content.footage = 1; content.footage <= 3; ++content.footage)
      if (meant == clip(content.footage)) return content;
    return content;  // a footage that nobody named
  }

  // The same of a file's text, without the program's reader.
  [[nodiscard]] Content content_of(const std::string& text, const fs::path& file) const {
    Project project;
    const auto value_of = [&](const std::string& key) {
      const std::size_t at = text.find("\"" + key + "\":");
      return at == std::string::npos ? std::string() : text.substr(at + key.size() + 3, 300);
    };
    const auto string_of = [&](const std::string& key) {
      const std::string value = value_of(key);
      const std::size_t from = value.find('"');
      return from == std::string::npos ? std::string() : value.substr(from + 1, value.find('"', from + 1) - from - 1);
    };
    project.file = file;
    project.name = string_of("name");
    project.footage.video = string_of("video");
    project.camera.speed_mps = std::atof(value_of("speed_mps").c_str());
    return content_of(project);
  }

  // Every file holds what the model says: the very bytes as long as nobody named it for writing.
  void compare() {
    for (const fs::path& file : files_) {
      const std::string name = file.string();
      const bool is_there = fs::exists(file);
      expect(is_there == (disk_.count(name) != 0), name + (is_there ? " was written" : " is gone"));
      if (!is_there || !failure_.empty()) continue;
      const std::string bytes = *read_text(file);
      if (bytes_.count(name) != 0) {
        expect(bytes == bytes_[name], name + " was written");
        continue;
      }
      expect(content_of(bytes, file) == disk_[name], name + " holds another project");
      bytes_[name] = bytes;
    }
    if (!has_project_) return;
    expect(document_->project().file == file_, "the project belongs to " + document_->project().file.string());
    expect(content_of(document_->project()) == states_[present_], "the project reads otherwise");
    expect(document_->has_unsaved_changes() == is_unsaved(), "unsaved changes are told wrongly");
    (void)session_->take_requests();
  }

  // What recovery holds, and which version of the project's file that editor knew.
  struct Kept {
    fs::path file;
    Content content;
    int known = 0;
  };

  TemporaryFolder folder_;
  std::mt19937_64 random_;
  std::vector<fs::path> files_;
  Settings settings_;
  std::unique_ptr<Document> document_;
  std::unique_ptr<ProjectSession> session_;
  double now_s_ = 0;
  std::string log_;
  std::string failure_;
  int last_speed_ = 0;
  int saves_ = 0;

  std::map<std::string, Content> disk_;
  std::map<std::string, std::string> bytes_;  // of files that were not named since
  std::map<std::string, int> versions_;
  bool has_project_ = false;
  fs::path file_;
  std::vector<Content> states_;
  std::size_t present_ = 0;
  std::optional<Content> saved_;
  int known_ = 0;  // the version of the project's file that was read or written last
  std::optional<Kept> kept_;
};

}  // namespace

TEST_CASE("whatever is opened, edited, undone, saved, recovered or killed, nothing is written that was not named") {
  const FoldersInMemory in_memory;
  constexpr int kSequences = 10'000;
  constexpr int kTogether = 100;  // sequences of one editor, each from where the one before ended
  constexpr int kActs = 5;
  int saves = 0;
  for (int first = 0; first < kSequences; first += kTogether) {
    EditorAndModel both(static_cast<std::uint64_t>(first));
    for (int sequence = 0; sequence < kTogether; ++sequence) {
      both.begin_sequence();
      for (int act = 0; act < kActs && both.failure().empty(); ++act) both.act();
      REQUIRE_MESSAGE(both.failure().empty(), "sequence " << first + sequence << ": " << both.failure());
    }
    saves += both.saves();
  }
  CHECK(saves > kSequences / 4);  // the sequences do save
}
