//! XML trees in which every node knows the place it came from
