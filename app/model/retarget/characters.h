#pragma once
#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "app/model/explorer/latest_job.h"
#include "core/model/model.h"

namespace sinew {

class RetargetReference;

/// One body of the line-up.
struct Character {
  std::string name;  ///< of the preset
  std::shared_ptr<const Model> model;
  double solve_s = 0;
};

/// The characters of the paper's first figure, retargeted one after the other beside the window.
class CharacterStudy : public QObject {
  Q_OBJECT
 public:
  explicit CharacterStudy(QObject* parent = nullptr);

  /// Nothing happens if they are there or on their way.
  void ask(std::shared_ptr<const RetargetReference> reference, const std::filesystem::path& resource_dir);
  void cancel() { job_.cancel(); }
  bool isBusy() const { return job_.isBusy(); }
  const std::vector<Character>& characters() const { return characters_; }  ///< empty until all are there
  const JobRunner& runner() const { return job_.runner(); }

 signals:
  void ready();
  void failed(const QString& message);

 private:
  std::vector<Character> characters_;
  LatestJob job_;
};

/// Their names in the order of the figure.
const std::vector<std::string>& characterNames();

}  // namespace sinew
