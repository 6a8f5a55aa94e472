//! Poses, angles and their exact printing
