//! STL, OBJ, COLLADA and glTF to triangles
