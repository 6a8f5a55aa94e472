// Where the oracle looks for what an <include> names. README.md states the rule.

#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

class ResourceSearch
{
 public:
  explicit ResourceSearch(const std::string &_file) : starts_{std::filesystem::path(_file)} {}

  /// The path for a URI, or "" for a miss; a model's folder or a file, as it exists.
  std::string find(const std::string &_uri)
  {
    // Libsdformat asks for one URI several times: the first answer holds for the whole load.
    for (const auto &[uri, path] : answers_)
      if (uri == _uri) return path;
    const std::string found = search(_uri);
    if (!found.empty())
    {
      // A model found here may include its own neighbours: they are searched upward from it too.
      const std::filesystem::path path(found);
      starts_.push_back(std::filesystem::is_directory(path) ? path / "model.sdf" : path);
    }
    answers_.emplace_back(_uri, found);
    return found;
  }

  const std::vector<std::pair<std::string, std::string>> &answers() const { return answers_; }

 private:
  static std::string environment(const char *_name)
  {
    const char *value = std::getenv(_name);
    return value ? value : "";
  }

  static bool exists(const std::filesystem::path &_path)
  {
    std::error_code ignored;
    return std::filesystem::exists(_path, ignored);
  }

  std::string search(const std::string &_uri) const
  {
    std::string name = _uri;
    const auto scheme_end = _uri.find("://");
    if (scheme_end != std::string::npos)
    {
      const std::string scheme = _uri.substr(0, scheme_end);
      if (scheme != "model" && scheme != "package" && scheme != "file") return "";
      name = _uri.substr(scheme_end + 3);
    }
    while (!name.empty() && name.front() == '/') name.erase(0, 1);
    if (name.empty()) return "";

    std::stringstream path_list(environment("PERIPLUS_ORACLE_PATH"));
    for (std::string dir; std::getline(path_list, dir, ':');)
      if (!dir.empty() && exists(std::filesystem::path(dir) / name))
        return (std::filesystem::path(dir) / name).string();

    for (const auto &start : starts_)
      for (const auto &dir : upward(start))
        for (const auto &place : {dir / name, dir / "models" / name})
          if (exists(place)) return place.string();
    return "";
  }

  /// The folders from the file's own up to its repository's root, or up to but without "/".
  static std::vector<std::filesystem::path> upward(const std::filesystem::path &_file)
  {
    const std::filesystem::path corpus(environment("PERIPLUS_ORACLE_ROOT"));
    std::vector<std::filesystem::path> dirs;
    for (auto dir = _file.parent_path(); dir != dir.root_path() && dir != corpus;
         dir = dir.parent_path())
      dirs.push_back(dir);
    return dirs;
  }

  std::vector<std::filesystem::path> starts_;
  std::vector<std::pair<std::string, std::string>> answers_;
};
