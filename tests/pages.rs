//! Examples of the pages, which run as tests of documentation. Everything else is in `it` and `architecture`.

/// Examples of README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct OfReadme;

/// Examples of the book.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct OfTheBook;
