// A caller of tf2's BufferCore: a chain of frames with a hundred stamped poses each, looked up by name.
// Prints "<what> <depth> <nanoseconds per look-up>" per line: the median of batches.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

static double median_of_batches(tf2::BufferCore& buffer, const std::string& to, const ros::Time& time) {
  double kept = 0.0;
  const auto batch = [&](int count) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) kept += buffer.lookupTransform("f0", to, time).transform.translation.x;
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    return took.count() / count;
  };
  // Batches shorter than a scheduler's slice, as in chains.rs.
  const double once = std::min({batch(20), batch(20), batch(20)});
  const int count = static_cast<int>(std::clamp(100000.0 / once, 10.0, 100000.0));
  std::vector<double> taken;
  for (int i = 0; i < 1001; ++i) taken.push_back(batch(count));
  if (std::isnan(kept)) std::puts("nan");
  std::sort(taken.begin(), taken.end());
  return taken[taken.size() / 2];
}

int main() {
  tf2::BufferCore buffer(ros::Duration(20.0));
  for (int frame = 1; frame <= 50; ++frame) {
    for (int at = 0; at < 100; ++at) {
      geometry_msgs::TransformStamped pose;
      pose.header.stamp = ros::Time(1000.0 + 0.1 * at);
      pose.header.frame_id = "f" + std::to_string(frame - 1);
      pose.child_frame_id = "f" + std::to_string(frame);
      pose.transform.translation.x = 0.1 + 0.001 * at;
      const double half = 0.05 + 0.0005 * at;
      pose.transform.rotation.z = std::sin(half);
      pose.transform.rotation.w = std::cos(half);
      buffer.setTransform(pose, "bench", false);
    }
  }
  for (const int depth : {1, 10, 50}) {
    const std::string to = "f" + std::to_string(depth);
    std::printf("latest %d %.1f\n", depth, median_of_batches(buffer, to, ros::Time(0)));
    std::printf("at %d %.1f\n", depth, median_of_batches(buffer, to, ros::Time(1005.05)));
  }
}
