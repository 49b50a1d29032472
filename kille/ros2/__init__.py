"""ROS 2 as a bus, experimental: its names and types over DDS, without ROS itself."""
