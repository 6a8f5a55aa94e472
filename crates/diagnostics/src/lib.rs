//! What is wrong, where (file:line:column), and what to do
