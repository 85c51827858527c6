mod answers;
mod brute;
mod canonical;
mod domains;
mod hostile;
mod many;
mod published;
mod snap;
