/* Finds the contact of two triangles. */
#include <stdio.h>

#include <sbcollide/collide_c.h>

int main(void) {
  const uint32_t corners[] = {0, 1, 2};
  const float x[] = {0, 1, 0, 0, -1, 0}, y[] = {0, 0, 1, 0, 0, -1}, z[] = {0, 0, 0, 0.05f, 0, 0};
  sbcollide_finder* finder = sbcollide_finder_new();
  if (!finder) return 2;
  if (sbcollide_finder_set(finder, SBCOLLIDE_TOLERANCE, 0.1) ||
      sbcollide_finder_add_body(finder, 3, corners, 1, NULL, 0, NULL) ||
      sbcollide_finder_add_body(finder, 3, corners, 1, NULL, 0, NULL) || sbcollide_finder_find(finder, x, y, z)) {
    fprintf(stderr, "%s\n", sbcollide_finder_error(finder));
    sbcollide_finder_free(finder);
    return 2;
  }
  for (size_t i = 0; i < sbcollide_finder_contact_count(finder); ++i) {
    const sbcollide_contact contact = sbcollide_finder_contacts(finder)[i];
    printf("vertices %u and %u\n", (unsigned)contact.a, (unsigned)contact.b);
  }
  sbcollide_finder_free(finder);
  return 0;
}
