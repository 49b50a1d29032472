// Opened as a file, a page may not read other pages: what is found has no excerpt then.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
