/* The few functions that Rust calls. Everything that depends on the layout of Cyclone's structures
   stays on this side of it: what crosses are handles, plain numbers and the structures below, whose
   sizes both sides check. `src/ffi.rs` says the same in Rust. */
#ifndef PERIPLUS_SHIM_H
#define PERIPLUS_SHIM_H

#include <stddef.h>
#include <stdint.h>

/* A sample: who wrote it, in the order of bytes on the wire, and its number. */
struct pp_identity {
  uint8_t guid[16];
  int64_t sequence;
};

/* Times in ns, INT64_MAX for infinite; kinds as in the DDS specification, counted from 0. */
struct pp_qos {
  int64_t deadline_ns;
  int64_t lifespan_ns;
  int64_t lease_ns;
  int64_t blocking_ns;
  int32_t reliability; /* 0 best effort, 1 reliable */
  int32_t durability;  /* 0 volatile .. 3 persistent */
  int32_t history;     /* 0 keep last, 1 keep all, -1 not told */
  int32_t depth;
  int32_t liveliness;  /* 0 automatic, 1 manual by participant, 2 manual by topic */
  int32_t unused;
};

/* A sample that was taken. The bytes were made by `buffer_new` and now belong to the caller. */
struct pp_sample {
  uint8_t *bytes;
  size_t size;
  int64_t time_ns;
  struct pp_identity writer;
  struct pp_identity related;
  uint8_t vendor[2];
  uint8_t has_writer;
  uint8_t has_related;
  uint8_t is_data;
  uint8_t unused[3];
};

/* What discovery says; strings and bytes live until `pp_discovery_return`. */
struct pp_found {
  void *loan;
  char *topic;
  char *type;
  uint8_t *user_data;
  size_t user_data_size;
  struct pp_qos qos;
  uint8_t guid[16];
  uint8_t participant[16];
  uint8_t vendor[2];
  uint8_t is_alive;
  uint8_t unused[5];
};

struct pp_hooks {
  uint8_t *(*buffer_new)(size_t size);
  void (*buffer_free)(uint8_t *bytes, size_t size);
  void (*owner_free)(void *owner);
  void (*log)(uint32_t category, const char *text);
};

size_t pp_size_of(int which);
void pp_init(const struct pp_hooks *hooks);
const char *pp_error(int32_t code);

/* 1 when the machine has an interface besides loopback that is up and has an address of IPv4. */
int32_t pp_has_network(void);
int32_t pp_domain(uint32_t id, const char *config);
int32_t pp_participant(uint32_t domain, const uint8_t *user_data, size_t size);
int32_t pp_topic(int32_t participant, const char *name, const char *type);
int32_t pp_writer(int32_t participant, int32_t topic, const struct pp_qos *qos,
                  const uint8_t *user_data, size_t size);
int32_t pp_reader(int32_t participant, int32_t topic, const struct pp_qos *qos,
                  const uint8_t *user_data, size_t size);
int32_t pp_delete(int32_t entity);
int32_t pp_guid(int32_t entity, uint8_t *guid);

/* Takes `owner`, which keeps `bytes` alive, in all cases. Unless `waits`, a writer without room is a
   timeout at once. */
int32_t pp_write(int32_t writer, const uint8_t *bytes, size_t size, void *owner,
                 const struct pp_identity *related, int32_t waits, int64_t *sequence);
/* The same for the readers of one participant alone, whose GUID prefix is given. 0 when it has no
   matched reader, otherwise 1. */
int32_t pp_send_to(int32_t writer, const uint8_t *bytes, size_t size, void *owner,
                   const struct pp_identity *related, const uint8_t *prefix, int64_t *sequence);
/* 1 when a reader of that participant is matched. */
int32_t pp_reaches(int32_t writer, const uint8_t *prefix);
int32_t pp_take(int32_t reader, struct pp_sample *sample);
int32_t pp_assert_liveliness(int32_t writer);
int32_t pp_wait_acknowledged(int32_t writer, int64_t timeout_ns);
/* How many ends of the other kind are matched now. */
int32_t pp_matched(int32_t endpoint, int32_t is_writer);

int32_t pp_discovery(int32_t participant, int32_t kind);
int32_t pp_discovery_take(int32_t reader, int32_t kind, struct pp_found *found);
void pp_discovery_return(int32_t reader, struct pp_found *found);

int32_t pp_waitset(int32_t participant);
/* `event`: 0 a guard is set, 1 a reader has data, 2 a writer's readers changed. */
int32_t pp_watch(int32_t waitset, int32_t entity, int32_t event);
/* Gives the entities with an event since the last call, and resets their events: an event that nobody
   handles is reported once. */
int32_t pp_wait(int32_t waitset, intptr_t *entities, size_t room, int64_t timeout_ns);
int32_t pp_guard(int32_t participant);
int32_t pp_guard_set(int32_t guard, int32_t on);

#endif
