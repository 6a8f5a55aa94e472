//! The simulator plugins we know, their parameters, and what people get wrong about them
