// What a page must not do while a journey is made: report an error, fall over, or ask another
// server for something.

/** Watches `page` and every other one of its browser; the journey may announce messages and requests that it provokes on purpose. */
export function watch(page, ownAddress) {
  const messages = [];
  const requests = [];
  const expectedMessages = [];
  const expectedRequests = [];
  const isOwn = (url) => url.startsWith(ownAddress) || /^(data|blob|about|chrome-error):/.test(url);

  const context = page.context();
  context.on("console", (message) => {
    if (message.type() === "error") messages.push(`console: ${message.text()}`);
  });
  context.on("weberror", (fault) => messages.push(`uncaught: ${fault.error().stack ?? fault.error()}`));
  const watchForCrash = (one) => one.on("crash", () => messages.push("the page crashed"));
  context.on("page", watchForCrash).pages().forEach(watchForCrash);
  context.on("request", (request) => {
    if (!isOwn(request.url())) requests.push(request.url());
  });

  const unexpected = (found, expected) =>
    found.filter((text) => !expected.some((pattern) => pattern.test(text)));
  return {
    expectMessage: (pattern) => expectedMessages.push(pattern),
    expectRequest: (pattern) => expectedRequests.push(pattern),
    /** Everything that nobody announced, in words. */
    complaints: () => [
      ...unexpected(messages, expectedMessages),
      ...unexpected(requests, expectedRequests).map((url) => `request to another server: ${url}`),
    ],
  };
}
