//! All tests of the book, in one binary.

mod bench;
mod book;
mod figures;
mod files;
mod mistakes;
mod pages;
mod published;
