// A program of Gazebo Transport that knows nothing of Periplus.
//
//   hear-scan TOPIC          says the frame, the count and the ranges of each scan
//   say-twist TOPIC X        publishes a velocity ten times a second
//   answer SERVICE           answers a text with the same text and `!`
//   ask SERVICE TEXT         asks so, and says what came back
#include <chrono>
#include <functional>
#include <iostream>
#include <string>
#include <thread>

#include <ignition/msgs.hh>
#include <ignition/transport.hh>

namespace
{
using Scan = ignition::msgs::LaserScan;
using Text = ignition::msgs::StringMsg;

void wait_for_the_end()
{
  // The tests end this program.
  std::this_thread::sleep_for(std::chrono::minutes(5));
}

void say(const Scan &scan)
{
  std::cout << scan.frame() << " " << scan.count();
  for (const double range : scan.ranges())
    std::cout << " " << range;
  std::cout << std::endl;
}

int hear_scan(ignition::transport::Node &node, const std::string &topic)
{
  std::function<void(const Scan &)> heard = say;
  if (!node.Subscribe(topic, heard))
    return 1;
  std::cout << "ready" << std::endl;
  wait_for_the_end();
  return 0;
}

int say_twist(ignition::transport::Node &node, const std::string &topic, double x)
{
  auto publisher = node.Advertise<ignition::msgs::Twist>(topic);
  ignition::msgs::Twist twist;
  twist.mutable_linear()->set_x(x);
  std::cout << "ready" << std::endl;
  for (int count = 0; count < 3000; ++count)
  {
    publisher.Publish(twist);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return 0;
}

int answer(ignition::transport::Node &node, const std::string &service)
{
  std::function<bool(const Text &, Text &)> answering = [](const Text &asked, Text &answered)
  {
    answered.set_data(asked.data() + "!");
    return asked.data() != "refuse";
  };
  if (!node.Advertise(service, answering))
    return 1;
  std::cout << "ready" << std::endl;
  wait_for_the_end();
  return 0;
}

int ask(ignition::transport::Node &node, const std::string &service, const std::string &text)
{
  Text asked, answered;
  asked.set_data(text);
  bool is_done = false;
  const bool is_answered = node.Request(service, asked, 20000u, answered, is_done);
  std::cout << is_answered << " " << is_done << " " << answered.data() << std::endl;
  return is_answered ? 0 : 1;
}
}

int main(int count, char **words)
{
  if (count < 3)
    return 2;
  const std::string what = words[1], name = words[2];
  ignition::transport::Node node;
  if (what == "hear-scan")
    return hear_scan(node, name);
  if (what == "say-twist" && count > 3)
    return say_twist(node, name, std::stod(words[3]));
  if (what == "answer")
    return answer(node, name);
  if (what == "ask" && count > 3)
    return ask(node, name, words[3]);
  return 2;
}
