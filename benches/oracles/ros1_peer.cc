// A node of roscpp that publishes or counts messages, for `cargo xtask bench ros1`.
//
// ros1_peer pub|sub cloud|small SECONDS
//
// A publisher waits for a subscriber. Both print one line of JSON: messages, bytes, CPU time [s].

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Float64MultiArray.h>
#include <sys/resource.h>

#include <cstdio>
#include <string>

namespace {

double cpu_s() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  auto seconds = [](const timeval &time) { return time.tv_sec + 1e-6 * time.tv_usec; };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

unsigned long count = 0;
unsigned long bytes = 0;

void on_cloud(const sensor_msgs::PointCloud2ConstPtr &cloud) {
  ++count;
  bytes += cloud->data.size();
}

void on_small(const std_msgs::Float64MultiArrayConstPtr &message) {
  ++count;
  bytes += 8 * message->data.size();
}

template <class Message>
void publish(ros::NodeHandle &node, const Message &message, double rate_hz, double duration_s) {
  auto publisher = node.advertise<Message>("/load", 100);
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  ros::WallDuration(0.5).sleep();
  double before = cpu_s();
  ros::WallRate rate(rate_hz);
  auto end = ros::WallTime::now() + ros::WallDuration(duration_s);
  while (ros::ok() && ros::WallTime::now() < end) {
    publisher.publish(message);
    ++count;
    rate.sleep();
  }
  ros::WallDuration(1.0).sleep();
  std::printf("{\"messages\": %lu, \"cpu_s\": %.3f}\n", count, cpu_s() - before);
}

}  // namespace

int main(int argc, char **argv) {
  ros::init(argc, argv, "ros1_peer", ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  ros::NodeHandle node;
  bool publishes = std::string(argv[1]) == "pub";
  bool is_cloud = std::string(argv[2]) == "cloud";
  double duration_s = std::stod(argv[3]);
  if (publishes && is_cloud) {
    sensor_msgs::PointCloud2 cloud;
    cloud.header.frame_id = "lidar";
    cloud.height = 1;
    cloud.width = 307200;
    cloud.point_step = 32;
    cloud.row_step = 9830400;
    cloud.data.resize(9830400, 7);
    publish(node, cloud, 30, duration_s);
  } else if (publishes) {
    std_msgs::Float64MultiArray small;
    small.data.resize(8, 1.0);
    publish(node, small, 1000, duration_s);
  } else {
    ros::Subscriber subscriber = is_cloud ? node.subscribe("/load", 100, on_cloud, ros::TransportHints().tcpNoDelay())
                                          : node.subscribe("/load", 100, on_small, ros::TransportHints().tcpNoDelay());
    while (ros::ok() && count == 0) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    double before = cpu_s();
    // It ends when no message came for two seconds.
    for (auto last = ros::WallTime::now(); ros::ok() && ros::WallTime::now() < last + ros::WallDuration(2.0);) {
      unsigned long known = count;
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
      if (count > known) last = ros::WallTime::now();
    }
    std::printf("{\"messages\": %lu, \"cpu_s\": %.3f, \"bytes\": %lu}\n", count, cpu_s() - before, bytes);
  }
  return 0;
}
