//! One door for every robot and world file: recognise, expand, read, check
