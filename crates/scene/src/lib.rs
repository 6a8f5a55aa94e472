//! The world as plain data: links, joints, frames, shapes, sensors
