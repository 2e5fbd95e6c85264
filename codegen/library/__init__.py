"""Where classes are found: packages on disk, the folders searched, and the nearest name to one that is not there."""
