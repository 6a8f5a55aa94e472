//! The xacro language: macros, properties and expressions over XML
