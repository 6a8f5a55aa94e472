// Runs a function in a child process with a time limit and brings its text back.

#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

constexpr unsigned kSecondsPerFile = 30;

struct ChildAnswer
{
  std::string text;
  /// Empty where the child ended well, else "timeout", "signal N", "exit N" or "exception: ...".
  std::string crash;
};

template <typename Function>
ChildAnswer inChild(Function _describe)
{
  constexpr int kThrew = 3;
  int ends[2];
  if (pipe(ends) != 0) { std::perror("pipe"); std::exit(2); }
  const pid_t child = fork();
  if (child < 0) { std::perror("fork"); std::exit(2); }
  if (child == 0)
  {
    close(ends[0]);
    alarm(kSecondsPerFile);
    std::string text;
    int status = 0;
    try { text = _describe(); }
    catch (const std::exception &e)
    {
      text = std::string("exception: ") + e.what();
      status = kThrew;
    }
    for (std::size_t done = 0; done < text.size();)
    {
      const ssize_t n = write(ends[1], text.data() + done, text.size() - done);
      if (n <= 0) _exit(4);
      done += static_cast<std::size_t>(n);
    }
    _exit(status);
  }
  close(ends[1]);
  ChildAnswer answer;
  char buffer[65536];
  for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    answer.text.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    answer.crash = WTERMSIG(status) == SIGALRM ? "timeout"
                                               : "signal " + std::to_string(WTERMSIG(status));
  else if (WEXITSTATUS(status) == kThrew)
    answer.crash = answer.text;
  else if (WEXITSTATUS(status) != 0)
    answer.crash = "exit " + std::to_string(WEXITSTATUS(status));
  return answer;
}
