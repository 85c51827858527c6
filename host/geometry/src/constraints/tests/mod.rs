mod answers;
mod brute;
mod canonical;
mod domains;
mod hostile;
mod published;
mod snap;
