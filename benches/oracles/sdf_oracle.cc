// Reads file names on stdin, prints one JSON line a file: what libsdformat12 makes of it. A line
// may be FILE, a tab, ORIGIN: then includes are searched as if FILE lay at ORIGIN (a file expanded
// from xacro elsewhere).
//
// Every file is loaded in a child process of its own with a time limit, so that a file which
// crashes or hangs the library costs one line, not the run. `--bench` loads all files in this
// process instead, prints nothing a file, and reports the seconds. The fields, the frames of the
// poses and the search rule for includes are in README.md beside this file.

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

#include "child_process.hh"
#include "json_writer.hh"
#include "resource_search.hh"
#include "sdf_dom.hh"
#include "sdf_tree.hh"

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t kConsoleLinesKept = 40;

void writeErrors(Json &_out, const sdf::Errors &_errors)
{
  _out.beginArray();
  for (const auto &e : _errors)
  {
    _out.beginObject();
    _out.key("code").number(static_cast<int>(e.Code()));
    _out.key("message").string(e.Message());
    if (e.LineNumber()) _out.key("line").number(*e.LineNumber());
    if (e.XmlPath()) _out.key("xml_path").string(*e.XmlPath());
    _out.endObject();
  }
  _out.endArray();
}

/// Whether the DOM holds every link, joint, frame and nested model of the model's element.
bool covers(const sdf::Model &_model, const sdf::ElementPtr &_elem)
{
  const auto nested = children(_elem, "model");
  if (_model.LinkCount() != children(_elem, "link").size() ||
      _model.JointCount() != children(_elem, "joint").size() ||
      _model.FrameCount() != children(_elem, "frame").size() ||
      _model.ModelCount() != nested.size())
    return false;
  for (std::size_t i = 0; i < nested.size(); ++i)
    if (!covers(*_model.ModelByIndex(i), nested[i])) return false;
  return true;
}

/// Whether the DOM holds every entity of the element tree: Root drops second models and names
/// used twice.
bool covers(const sdf::Root &_root, const sdf::ElementPtr &_tree)
{
  const auto worlds = children(_tree, "world");
  const auto models = children(_tree, "model");
  if (_root.WorldCount() != worlds.size() || models.size() > 1 ||
      (_root.Model() != nullptr) != !models.empty() ||
      (_root.Light() != nullptr) != !children(_tree, "light").empty())
    return false;
  for (std::size_t w = 0; w < worlds.size(); ++w)
  {
    const auto &world = *_root.WorldByIndex(w);
    const auto inside = children(worlds[w], "model");
    if (world.ModelCount() != inside.size() ||
        world.LightCount() != children(worlds[w], "light").size())
      return false;
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (!covers(*world.ModelByIndex(i), inside[i])) return false;
  }
  return models.empty() || covers(*_root.Model(), models.front());
}

/// The first element's name decides: `robot` is URDF.
std::string kindOf(const std::string &_file)
{
  std::ifstream in(_file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  const std::string s = text.str();
  for (std::size_t at = s.find('<'); at != std::string::npos; at = s.find('<', at))
  {
    if (s.compare(at, 4, "<!--") == 0)
    {
      at = s.find("-->", at);
      if (at == std::string::npos) break;
    }
    else if (s.compare(at, 2, "<?") == 0 || s.compare(at, 2, "<!") == 0)
      ++at;
    else
      return s.compare(at, 6, "<robot") == 0 ? "urdf" : "sdf";
  }
  return "sdf";
}

/// The checks that `ign sdf -k` makes after Root::Load; they explain themselves on stderr.
bool passesChecks(const sdf::Root &_root)
{
  sdf::Errors joint_errors;
  sdf::checkJointParentChildNames(&_root, joint_errors);
  for (const auto &e : joint_errors) std::cerr << "Error: " << e.Message() << "\n";
  bool ok = joint_errors.empty();
  ok &= sdf::checkCanonicalLinkNames(&_root);
  ok &= sdf::checkFrameAttachedToGraph(&_root);
  ok &= sdf::checkPoseRelativeToGraph(&_root);
  ok &= sdf::recursiveSiblingNoDoubleColonInNames(_root.Element());
  return ok;
}

std::vector<std::string> readLines(std::FILE *_file)
{
  std::vector<std::string> lines;
  std::rewind(_file);
  std::string line;
  for (int c; (c = std::fgetc(_file)) != EOF && lines.size() < kConsoleLinesKept;)
  {
    if (c != '\n') { line += static_cast<char>(c); continue; }
    if (!line.empty()) lines.push_back(line);
    line.clear();
  }
  if (!line.empty() && lines.size() < kConsoleLinesKept) lines.push_back(line);
  return lines;
}

/// One line of the input: a file, and the path whose surroundings are searched for it.
struct Job
{
  std::string file;
  std::string origin;
};

std::string describe(const Job &_job)
{
  const std::string &file = _job.file;
  // The library explains part of what it dislikes on stderr only: keep that with the answer.
  std::FILE *console = std::tmpfile();
  if (console) dup2(fileno(console), STDERR_FILENO);

  ResourceSearch search(_job.origin);
  sdf::ParserConfig config;
  const auto find = [&search](const std::string &_uri) { return search.find(_uri); };
  config.SetFindCallback(find);
  // Libsdformat 12 forgets the configuration inside an included file and asks the global one.
  sdf::ParserConfig::GlobalConfig().SetFindCallback(find);

  Json out;
  out.beginObject();
  out.key("file").string(file);
  if (_job.origin != file) out.key("origin").string(_job.origin);
  out.key("kind").string(kindOf(file));

  sdf::SDFPtr tree(new sdf::SDF());
  sdf::init(tree);
  sdf::Errors read_errors;
  const bool read_ok = sdf::readFile(file, config, tree, read_errors);

  sdf::Root root;
  const sdf::Errors root_errors = root.Load(file, config);
  const bool strict_ok = root_errors.empty() && root.Element() && passesChecks(root);

  out.key("ok").boolean(read_ok);
  out.key("root_ok").boolean(root_errors.empty());
  out.key("strict_ok").boolean(strict_ok);
  out.key("read_and_root_differ").boolean(read_ok != root_errors.empty());
  out.key("errors");
  // Root::Load reads the file itself, so its errors include those of the reading.
  writeErrors(out, root_errors.empty() ? read_errors : root_errors);
  if (read_ok)
  {
    out.key("original_version").string(tree->OriginalVersion());
    // The DOM may lack what it found in error: then the tree as written is given beside it.
    const bool complete = covers(root, tree->Root());
    Json body;
    g_unresolved = 0;
    writeRoot(body, root);
    out.key("semantic").boolean(complete && g_unresolved == 0);
    out.key("complete").boolean(complete);
    out.key("unresolved").number(g_unresolved);
    out.fields(body.text());
    if (!complete)
    {
      Json raw;
      writeRawRoot(raw, tree->Root());
      out.key("tree").beginObject().fields(raw.text()).endObject();
    }
  }
  out.key("includes").beginArray();
  for (const auto &[uri, path] : search.answers())
    out.beginArray().string(uri).string(path).endArray();
  out.endArray();
  std::fflush(stderr);
  out.key("console").beginArray();
  if (console)
    for (const auto &line : readLines(console)) out.string(line);
  out.endArray();
  return out.endObject().text();
}

/// The line for a job, whatever becomes of the process that makes it.
std::string answer(const Job &_job)
{
  const ChildAnswer answer = inChild([&_job] { return describe(_job); });
  if (answer.crash.empty()) return answer.text;
  Json out;
  out.beginObject().key("file").string(_job.file);
  if (_job.origin != _job.file) out.key("origin").string(_job.origin);
  out.key("kind").string(kindOf(_job.file));
  out.key("ok").boolean(false).key("root_ok").boolean(false).key("strict_ok").boolean(false);
  return out.key("crash").string(answer.crash).endObject().text();
}

int bench(const std::vector<Job> &_jobs)
{
  const int sink = open("/dev/null", O_WRONLY);
  const int real_stderr = dup(STDERR_FILENO);
  dup2(sink, STDERR_FILENO);
  sdf::Console::Instance()->SetQuiet(true);
  int loaded = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const auto &job : _jobs)
  {
    ResourceSearch search(job.origin);
    sdf::ParserConfig config;
    const auto find = [&search](const std::string &_uri) { return search.find(_uri); };
    config.SetFindCallback(find);
    sdf::ParserConfig::GlobalConfig().SetFindCallback(find);
    sdf::Root root;
    if (root.Load(job.file, config).empty()) ++loaded;
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  dup2(real_stderr, STDERR_FILENO);
  Json out;
  out.beginObject().key("files").number(static_cast<double>(_jobs.size()));
  out.key("loaded_without_error").number(loaded).key("seconds").number(spent.count());
  std::cout << out.endObject().text() << "\n";
  return 0;
}
}  // namespace

int main(int argc, char **argv)
{
  std::ios::sync_with_stdio(false);
  std::vector<Job> jobs;
  for (std::string line; std::getline(std::cin, line);)
  {
    if (line.empty()) continue;
    const auto tab = line.find('\t');
    const auto file = fs::absolute(line.substr(0, tab)).lexically_normal().string();
    jobs.push_back({file, tab == std::string::npos
                              ? file
                              : fs::absolute(line.substr(tab + 1)).lexically_normal().string()});
  }
  // Relative include URIs must not be found by luck in the caller's directory.
  if (chdir("/") != 0) return 2;
  if (argc > 1 && std::string(argv[1]) == "--bench") return bench(jobs);
  for (const auto &job : jobs) std::cout << answer(job) << "\n" << std::flush;
  return 0;
}
