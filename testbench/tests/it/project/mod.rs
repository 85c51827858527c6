//! What holds for the project as a whole: who may use whom, and the documents.

mod dependencies;
mod documents;
mod rules;
