"""Logging behind `rclpy.logging`."""
