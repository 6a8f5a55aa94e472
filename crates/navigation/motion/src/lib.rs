//! Velocity smoother, collision monitor and recovery motions with the behaviour of Nav2.
