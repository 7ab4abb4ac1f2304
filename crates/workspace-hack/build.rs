//! Empty: it is here because the features of procedural macros are those of build dependencies.

fn main() {}
