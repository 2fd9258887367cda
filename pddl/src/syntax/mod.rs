//! Lossless syntax: every byte of the text is in the tree, and there is always a tree.
//!
//! Problem: a formatter and an editor need comments and broken files, the model needs neither. Idea: tokens
//! tile the text ([`Tokens`]); over them lie lists and atoms ([`Tree`], [`Node`]) in one flat preorder
//! array. [`parse`] never fails: it returns the tree and what is wrong with it. Cost: linear in the text; 16
//! bytes a node, none a token.

mod build;
mod layout;
mod lexer;
mod token;
mod tokens;
mod tree;

pub use build::parse;
pub use token::TokenKind;
pub use tokens::Tokens;
pub use tree::{Children, Node, NodeKind, Tree};
