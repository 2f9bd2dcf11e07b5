#include "snapshot_series.h"

#include <fmt/format.h>

#include <charconv>

#include "atomic_file.h"
#include "coupling/errors.h"

namespace vesiflow::coupling {

std::string step_group(long step) {
  return fmt::format("/steps/{:09d}", step);
}

namespace {

long step_of(const std::string& group, const std::filesystem::path& path) {
  long step = 0;
  const char* end = group.data() + group.size();
  if (std::from_chars(group.data(), end, step).ptr != end)
    throw FileError(fmt::format("{}: /steps/{} is no step", path.string(), group));
  return step;
}

}  // namespace

std::map<long, double> stored_steps(const std::filesystem::path& path) {
  std::map<long, double> steps;
  if (!std::filesystem::exists(path)) return steps;
  const Hdf5File file(path, Hdf5File::Mode::read);
  for (const std::string& name : file.children("/steps"))
    steps[step_of(name, path)] = file.read_number("/steps/" + name, "time");
  return steps;
}

void append_snapshot(const std::filesystem::path& path, long step, double time,
                     const std::function<void(Hdf5File&)>& begin,
                     const std::function<void(Hdf5File&, const std::string&)>& add) {
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    const bool extend = std::filesystem::exists(path);
    if (extend) std::filesystem::copy_file(path, temporary, std::filesystem::copy_options::overwrite_existing);
    Hdf5File file(temporary, extend ? Hdf5File::Mode::append : Hdf5File::Mode::create);
    if (!extend) begin(file);
    const std::string group = step_group(step);
    file.attribute(group, "step", static_cast<std::int64_t>(step));
    file.attribute(group, "time", time);
    add(file, group);
    file.close();
  });
}

void drop_after(const std::filesystem::path& path, long step) {
  const std::map<long, double> steps = stored_steps(path);
  if (steps.empty() || steps.rbegin()->first <= step) return;
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::filesystem::copy_file(path, temporary, std::filesystem::copy_options::overwrite_existing);
    Hdf5File file(temporary, Hdf5File::Mode::append);
    for (auto it = steps.upper_bound(step); it != steps.end(); ++it) file.remove(step_group(it->first));
    file.close();
  });
}

}  // namespace vesiflow::coupling
