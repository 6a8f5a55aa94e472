//! URDF with Gazebo's extensions, read into a scene and written from one
