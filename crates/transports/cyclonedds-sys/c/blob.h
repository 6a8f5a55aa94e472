/* Samples as bytes that nobody here looks into. */
#ifndef PERIPLUS_BLOB_H
#define PERIPLUS_BLOB_H

#include <stdbool.h>

#include "dds/ddsi/ddsi_guid.h"
#include "dds/ddsi/ddsi_serdata.h"
#include "shim.h"

struct pp_blob {
  struct ddsi_serdata c;
  uint8_t *bytes; /* with the four of the encapsulation in front */
  size_t size;
  void *owner;    /* keeps the bytes; without it they are a buffer of `buffer_new` */
  bool has_writer;
  bool has_related;
  bool has_destination;
  ddsi_guid_prefix_t destination; /* the only participant that gets it */
  uint8_t vendor[2];
  struct pp_identity writer;
  struct pp_identity related;
};

extern struct pp_hooks pp_hooks;
extern const struct ddsi_serdata_ops pp_blob_ops;

struct ddsi_sertype *pp_blob_type(const char *name);
struct pp_blob *pp_blob_new(const struct ddsi_sertype *type, enum ddsi_serdata_kind kind);

#endif
